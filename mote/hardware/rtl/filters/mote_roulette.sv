// Roulette resampling: a random number for each child, sought among the cumulative sums by a pipelined binary search.
//
//   parent of child j: the least i with  w_0 + ... + w_i > u_j T,   T = sum w,  u_j ~ U[0, 1) of 24 bits
//
// Sums are taken as the weights come, at the scale of the moment, so that no second pass is needed; a sum three quanta below
// the scale counts as nothing. The last particle takes what is above all other sums. No child is drawn when no step follows.
//
// formats  weights: unsigned; sums and thresholds: exact integers of Width + At bits, u_j T cut
// range    1 <= n_i <= 2^At, At >= 2
// timing   the first parent shows 5 + Product + 4 At cycles after total_valid_i, which may come a cycle after the last weight; then
//          one a cycle. A queue lets it run ahead
// golden   mote/hardware/filters/roulette.hpp
// source   FPGA, sec. II: r ~ U[0, 1], the first particle whose cumulative sum passes r
module mote_roulette #(
    parameter int unsigned At         = 10,
    parameter int unsigned Width      = 24,
    parameter int unsigned ScaleWidth = 12,
    parameter int unsigned Product    = 1,
    localparam int unsigned SumWidth  = Width + At
) (
    input  logic                         clk_i,
    input  logic                         rst_ni,
    input  logic        [At:0]           n_i,
    // weights, slot after slot
    input  logic                         write_i,
    input  logic                         last_i,
    input  logic        [Width-1:0]      weight_i,
    input  logic signed [ScaleWidth-1:0] scale_i,
    // the end of a step
    input  logic                         total_valid_i,
    input  logic        [SumWidth-1:0]   total_i,
    input  logic                         more_i,  // a step follows
    // a uniform number for each child
    output logic                         draw_o,
    input  logic        [23:0]           uniform_i,
    // parents, child after child
    output logic                         valid_o,
    input  logic                         ready_i,
    output logic        [At-1:0]         parent_o
);
  localparam int unsigned Latency = 3 + Product + 4 * At;     // from drawing to the queue
  localparam int unsigned Parents = 1 << $clog2(Latency + 4);  // so that the queue never runs dry
  localparam int unsigned RoomWidth = $clog2(Parents) + 1;
  localparam int unsigned Low = 17;                           // bits of the total that one multiplier takes
  typedef logic [At:0] count_t;

  // ---- sums so far
  logic [At-1:0] number_q, number1_q, number2_q;  // of the weights in a sum: the last, maybe 2^At, is not stored
  logic valid1_q, valid2_q, last1_q, last2_q, bank_q;
  logic [1:0] rise1_q;
  logic [Width-1:0] weight1_q;
  logic [ScaleWidth-1:0] rise;
  logic signed [ScaleWidth-1:0] scale1_q, scale2_q;
  logic [SumWidth-1:0] sum_q;
  assign rise = scale_i - scale1_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {valid1_q, valid2_q, last1_q, last2_q} <= '0;
      number_q <= '0;
      bank_q   <= 1'b0;
    end else begin
      {valid1_q, valid2_q, last1_q, last2_q} <= {write_i, valid1_q, last_i, last1_q};
      if (write_i) number_q <= last_i ? '0 : number_q + At'(1);
      if (last2_q) bank_q <= ~bank_q;
    end
  end
  always_ff @(posedge clk_i) begin
    if (write_i) scale1_q <= scale_i;
    weight1_q <= weight_i;
    number1_q <= number_q + At'(1);
    rise1_q   <= number_q == '0 || rise > ScaleWidth'(2) ? 2'd3 : rise[1:0];
    if (valid1_q) sum_q <= (rise1_q == 2'd3 ? '0 : sum_q >> {rise1_q, 3'b0}) + SumWidth'(weight1_q);
    scale2_q  <= scale1_q;
    number2_q <= number1_q;
  end

  // ---- children are drawn as long as the queue will have room
  count_t left_q;
  logic [RoomWidth-1:0] room_q;
  logic signed [ScaleWidth-1:0] last_scale_q;
  logic [SumWidth-1:0] total_q;
  logic pop;
  assign draw_o = left_q != '0 && room_q != '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q <= '0;
      room_q <= RoomWidth'(Parents);
    end else begin
      if (total_valid_i) left_q <= more_i ? n_i : '0;
      else if (draw_o) left_q <= left_q - (At + 1)'(1);
      room_q <= room_q - RoomWidth'(draw_o) + RoomWidth'(pop);
    end
  end
  always_ff @(posedge clk_i) begin
    if (total_valid_i) begin
      total_q      <= total_i;
      last_scale_q <= scale1_q;
    end
  end

  // ---- thresholds
  logic [23:0] uniform_q;
  logic [Low+23:0] low, low2_q;
  logic [SumWidth-Low+23:0] high, high2_q;
  mote_times #(.AWidth(Low), .BWidth(24), .Product(Product)) u_low (
      .clk_i, .a_i(total_q[Low-1:0]), .b_i(uniform_q), .p_o(low));
  mote_times #(.AWidth(SumWidth - Low), .BWidth(24), .Product(Product)) u_high (
      .clk_i, .a_i(total_q[SumWidth-1:Low]), .b_i(uniform_q), .p_o(high));
  logic [SumWidth-1:0] threshold_q;
  always_ff @(posedge clk_i) begin
    uniform_q   <= uniform_i;
    low2_q      <= low;
    high2_q     <= high;
    threshold_q <= SumWidth'(({high2_q, {Low{1'b0}}} + (SumWidth + 24)'(low2_q)) >> 24);
  end

  // ---- the search, a level after the other
  logic [(At+1)*At-1:0] place;
  logic [(At+1)*SumWidth-1:0] threshold;
  assign place[At-1:0] = '0;
  assign threshold[SumWidth-1:0] = threshold_q;
  for (genvar k = 0; k < At; k++) begin : gen_level
    mote_search_level #(.At(At), .Bit(At - 1 - k), .SumWidth(SumWidth), .ScaleWidth(ScaleWidth)) u_level (
        .clk_i, .n_i,
        .write_i(valid2_q),
        .write_bank_i(bank_q),
        .number_i(number2_q),
        .sum_i(sum_q),
        .scale_i(scale2_q),
        .read_bank_i(~bank_q),
        .last_scale_i(last_scale_q),
        .place_i(place[k*At+:At]),
        .threshold_i(threshold[k*SumWidth+:SumWidth]),
        .place_o(place[(k+1)*At+:At]),
        .threshold_o(threshold[(k+1)*SumWidth+:SumWidth]));
  end
  logic unused_threshold;
  assign unused_threshold = ^threshold[(At+1)*SumWidth-1-:SumWidth];

  // ---- parents
  logic found, no_parent, unused_full;
  mote_valid #(.Depth(Latency)) u_found (.clk_i, .rst_ni, .valid_i(draw_o), .valid_o(found));
  mote_fifo #(.Width(At), .Depth(Parents)) u_parents (
      .clk_i, .rst_ni, .clear_i(1'b0),
      .push_i(found), .word_i(place[At*(At+1)-1-:At]),
      .pop_i(pop), .word_o(parent_o), .empty_o(no_parent), .full_o(unused_full));
  assign valid_o = !no_parent;
  assign pop = valid_o && ready_i;
endmodule
