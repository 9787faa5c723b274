// Residual-systematic resampling: a weight a cycle, how many children it has, and what is left for the next.
//
//   x_i = w_i q + v_i,  n_i = floor(x_i),  v_(i+1) = x_i - n_i;   q = N / T,  T = sum w,  v_0 ~ U[0, 1) of 24 bits
//   w_i as Width bits of T, of which all but 17 are carried to the next weight; the last particle has the children that are left
//
// These are mote_offspring's children: n_0 + ... + n_i = floor(C_i q + v_0). N / T is a factor (mote_reciprocal), never too
// large. Weights are stored with the scale that they were made at and lowered to the last one's when they are read. No
// child is drawn when no step follows.
//
// formats  weights: unsigned
// range    1 <= n_i <= 2^At, At >= 6
// timing   weights are read from the cycle after total_valid_i on, which comes a cycle after the last weight; a particle's
//          first child shows 10 cycles after it is read, one child a cycle. A queue of Parents lets it run ahead
// golden   mote/hardware/filters/residual.hpp
// source   Bolic, Djuric & Hong 2003 (residual-systematic resampling)
module mote_residual_systematic #(
    parameter int unsigned At         = 10,
    parameter int unsigned Width      = 24,
    parameter int unsigned ScaleWidth = 12,
    parameter int unsigned Parents    = 128,
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
    input  logic        [23:0]           uniform_i,
    input  logic                         more_i,  // a step follows
    // parents, child after child
    output logic                         valid_o,
    input  logic                         ready_i,
    output logic        [At-1:0]         parent_o
);
  localparam int unsigned Latency = 9;               // from reading a weight to its children
  localparam int unsigned WordWidth = Width + ScaleWidth;
  localparam int unsigned Drop = At - 6;             // bits of N times the reciprocal that are left out
  localparam int unsigned Frac = 34 - Drop;          // fraction bits of w q
  localparam int unsigned Rest = Width - 17;         // bits of a weight that are carried to the next
  localparam int unsigned Fraction = 16;             // that a lowered weight keeps, for the total's leading zeros
  localparam int unsigned RoomWidth = $clog2(Parents) + 1;
  localparam int unsigned ZerosWidth = $clog2(SumWidth);
  typedef logic [At:0] count_t;

  // ---- memory of weights, two banks
  logic [At-1:0] written_q;
  logic bank_q;
  logic signed [ScaleWidth-1:0] last_scale_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      written_q <= '0;
      bank_q    <= 1'b0;
    end else if (write_i) begin
      written_q <= last_i ? '0 : written_q + At'(1);
      bank_q    <= bank_q ^ last_i;
    end
  end
  always_ff @(posedge clk_i) if (last_i) last_scale_q <= scale_i;

  // ---- reading, as long as the queue will have room
  logic reads, last_read, pop, left_out;
  count_t left_q;
  logic [RoomWidth-1:0] room_q;
  logic [At-1:0] slot_q;
  assign reads = left_q != '0 && room_q != '0;
  assign last_read = left_q == (At + 1)'(1);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q <= '0;
      room_q <= RoomWidth'(Parents);
    end else begin
      if (total_valid_i) left_q <= more_i ? n_i : '0;
      else if (reads) left_q <= left_q - (At + 1)'(1);
      room_q <= room_q - RoomWidth'(reads) + RoomWidth'(pop) + RoomWidth'(left_out);
    end
  end
  always_ff @(posedge clk_i) begin
    if (total_valid_i) slot_q <= '0;
    else if (reads) slot_q <= slot_q + At'(1);
  end
  logic [WordWidth-1:0] word;
  mote_ram #(.Width(WordWidth), .Words(2 << At)) u_weights (
      .clk_i,
      .write_i,
      .write_at_i({bank_q, written_q}),
      .write_word_i({scale_i, weight_i}),
      .read_at_i({~bank_q, slot_q}),
      .read_word_o(word));

  // ---- the factor N / T
  logic [ZerosWidth-1:0] zeros;
  logic [17:0] reciprocal;
  logic [At+18:0] product_n_q;
  logic [23:0] factor_q;
  logic unused_product;
  mote_reciprocal #(.Width(SumWidth), .MostZeros(At + 8)) u_reciprocal (
      .clk_i, .load_i(total_valid_i), .divisor_i(total_i), .zeros_o(zeros), .reciprocal_o(reciprocal));
  always_ff @(posedge clk_i) begin
    product_n_q <= (At + 19)'(reciprocal) * (At + 19)'(n_i);
    factor_q    <= product_n_q[Drop+:24];
  end
  assign unused_product = ^product_n_q;

  // ---- shares of T: what is cut off goes to the next weight
  logic [ScaleWidth-1:0] by;
  logic [Width+Fraction-1:0] lowered_q;
  logic [SumWidth+Fraction-1:0] coarse;
  logic [SumWidth-1:0] coarse_q, fine;
  logic [Width-1:0] fine_q, sum;
  logic [Rest-1:0] rest_q;
  logic [16:0] share_q;
  logic share_valid, unused_cut;
  mote_valid #(.Depth(5)) u_share_valid (.clk_i, .rst_ni, .valid_i(reads), .valid_o(share_valid));
  assign by = last_scale_q - $signed(word[WordWidth-1:Width]);
  assign coarse = (SumWidth + Fraction)'(lowered_q) << {zeros[ZerosWidth-1:3], 3'b0};
  assign fine = coarse_q << zeros[2:0];
  assign sum = fine_q + Width'(rest_q);
  assign unused_cut = ^{coarse[Fraction-1:0], fine[At-1:0]};
  always_ff @(posedge clk_i) begin
    lowered_q <= by > ScaleWidth'(2) ? '0 : {word[Width-1:0], {Fraction{1'b0}}} >> {by[1:0], 3'b0};
    coarse_q  <= coarse[SumWidth+Fraction-1:Fraction];
    fine_q    <= fine[SumWidth-1:At];
    share_q   <= sum[Width-1:Rest];
    if (total_valid_i) rest_q <= '0;
    else if (share_valid) rest_q <= sum[Rest-1:0];
  end

  // ---- children, and the residual
  logic [40:0] product_q, product2_q;
  logic [40:0] place;
  logic [Frac-1:0] residual_q;
  logic place_valid, last8, child_valid_q;
  logic [At-1:0] slot8, child_slot_q;
  count_t children, children_q, children_left_q;
  mote_valid #(.Depth(Latency - 1)) u_place_valid (.clk_i, .rst_ni, .valid_i(reads), .valid_o(place_valid));
  mote_delay #(.Width(At + 1), .Depth(Latency - 1)) u_slot (.clk_i, .d_i({last_read, slot_q}), .d_o({last8, slot8}));
  assign place = product2_q + 41'(residual_q);
  assign children = last8 ? children_left_q : place[Frac+:At+1];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) child_valid_q <= 1'b0;
    else child_valid_q <= place_valid;
  end
  always_ff @(posedge clk_i) begin
    product_q  <= 41'(share_q) * 41'(factor_q);
    product2_q <= product_q;
    if (total_valid_i) begin
      residual_q      <= {uniform_i, {(Frac - 24) {1'b0}}};
      children_left_q <= n_i;
    end else if (place_valid) begin
      residual_q      <= place[Frac-1:0];
      children_left_q <= children_left_q - children;
    end
    children_q   <= children;
    child_slot_q <= slot8;
  end
  assign left_out = child_valid_q && children_q == '0;

  // ---- parents, each as often as it has children
  count_t repeats, shown_q;
  logic no_parent, unused_full;
  mote_fifo #(.Width(2 * At + 1), .Depth(Parents)) u_parents (
      .clk_i, .rst_ni, .clear_i(1'b0),
      .push_i(child_valid_q && !left_out), .word_i({child_slot_q, children_q}),
      .pop_i(pop), .word_o({parent_o, repeats}), .empty_o(no_parent), .full_o(unused_full));
  assign valid_o = !no_parent;
  assign pop = valid_o && ready_i && shown_q + (At + 1)'(1) == repeats;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) shown_q <= '0;
    else if (valid_o && ready_i) shown_q <= pop ? '0 : shown_q + (At + 1)'(1);
  end
endmodule
