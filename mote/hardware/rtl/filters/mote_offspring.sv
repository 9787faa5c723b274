// Systematic resampling: how many children the particles so far have, a row of 2 Lanes particles a cycle.
//
//   J_i = floor(C_i q + v),  C_i = w_0 + ... + w_i as 17 bits of T = sum w,  q = N / T,  v ~ U[0, 1) of 24 bits
//   particle i has the children J_(i-1) .. J_i - 1; the last one's J is N
//
// Weights are kept in short and lowered to the last one's scale when they are read, as Width bits of T (mote_share), so that no
// C is above T. N / T is a factor (mote_reciprocal), never too large; so no J is above N, and the last particle gains below
// N 2^-13 children. Rows without children are left out; those after the last child are not read.
//
// formats  short_i, rise_i, scale_i: mote_weight's, of the scale its 3 lowest bits; ends_o: the J of a row's particles; row_o: the row's number
// range    n_i counts slots of Lanes particles, N = Lanes n_i; Lanes 1, 2, 4 or 8; At >= 6; T >= 2^(Width - 8)
// timing   the first row is there 8 + 3 Product + 2 log2 Lanes cycles after the last weight is written, initiation interval 1 until the
//          queue of Rows is full. total_i comes with total_valid_i 1 + log2 Lanes cycles after the last
//          weight
// golden   mote/hardware/filters/offspring.hpp
// source   Kitagawa 1996 (systematic resampling)
module mote_offspring #(
    parameter int unsigned Lanes      = 1,
    parameter int unsigned At         = 10,
    parameter int unsigned Width      = 24,
    parameter int unsigned Rows       = 32,
    parameter int unsigned Product    = 1,
    localparam int unsigned Many      = 2 * Lanes,
    localparam int unsigned RowWidth  = At - $clog2(Many),
    localparam int unsigned SumWidth  = Width + At
) (
    input  logic                         clk_i,
    input  logic                         rst_ni,
    input  logic                         drop_i,  // what a run left, until another one's first weight
    input  logic        [At:0]           n_i,
    // weights, slot after slot
    input  logic                         write_i,
    input  logic                         last_i,
    input  logic [Lanes*18-1:0]          short_i,
    input  logic        [1:0]            rise_i,
    input  logic        [2:0]            scale_i,
    // the end of a step
    input  logic                         total_valid_i,
    input  logic        [SumWidth-1:0]   total_i,
    input  logic        [23:0]           uniform_i,
    // rows with children
    output logic                         valid_o,
    input  logic                         pop_i,
    output logic [RowWidth-1:0]          row_o,
    output logic [Many*(At+1)-1:0]       ends_o
);
  localparam int unsigned Levels = $clog2(Many);
  localparam int unsigned Latency = 7 + Product + Levels;  // from reading a row to its ends
  // Cycles that reading waits for the total's leading zeros, and for the factor where its products take longer.
  localparam int unsigned Later = $clog2(Lanes) + 2 * (Product - 1);
  localparam int unsigned Drop = At - 6;         // bits of N times the reciprocal that are left out
  localparam int unsigned Frac = 34 - Drop;      // fraction bits of C q
  localparam int unsigned RoomWidth = $clog2(Rows) + 1;
  typedef logic [At:0] count_t;
  typedef logic [RowWidth-1:0] row_t;

  // ---- memory of weights, even and odd slots, two banks
  logic [At:0] written_q;
  logic bank_q, begins;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      written_q <= '0;
      bank_q <= 1'b0;
    end else begin
      if (write_i) written_q <= last_i ? '0 : written_q + (At + 1)'(1);
      if (last_i) bank_q <= ~bank_q;
    end
  end
  row_t row_q;
  logic [RowWidth:0] write_at, read_at;
  assign write_at = {bank_q, written_q[RowWidth:1]};
  assign read_at = {~bank_q, row_q};
  logic [Many*18-1:0] word;
  for (genvar h = 0; h < 2; h++) begin : gen_half
    for (genvar l = 0; l < Lanes; l++) begin : gen_lane
      mote_ram #(.Width(18), .Words(2 << RowWidth)) u_weights (
          .clk_i,
          .write_i(write_i && written_q[0] == 1'(h)),
          .write_at_i(write_at),
          .write_word_i(short_i[l*18+:18]),
          .read_at_i(read_at),
          .read_word_o(word[(h*Lanes+l)*18+:18]));
    end
  end

  // ---- reading, as long as the queue has room
  mote_valid #(.Depth(Later)) u_begins (.clk_i, .rst_ni, .valid_i(last_i), .valid_o(begins));
  logic reads_q, reads, last_row, left_out, left_out_q, popped_q, push, arrives, all_q;
  logic [RoomWidth-1:0] room_q;
  assign last_row = row_q == RowWidth'((n_i - (At + 1)'(1)) >> 1);
  assign reads = reads_q && room_q != '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      reads_q <= 1'b0;
      room_q  <= RoomWidth'(Rows);
    end else if (drop_i) begin
      reads_q <= 1'b0;
      room_q  <= RoomWidth'(Rows);
    end else begin
      if (begins) reads_q <= 1'b1;
      else if (all_q || reads && last_row) reads_q <= 1'b0;
      room_q <= room_q - RoomWidth'(reads) + RoomWidth'(popped_q) + RoomWidth'(left_out_q);
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {popped_q, left_out_q, all_q} <= '0;
    else {popped_q, left_out_q, all_q} <= {pop_i && !drop_i, left_out && !drop_i, push && row_end == all_n};
  end
  always_ff @(posedge clk_i) begin
    if (last_i) row_q <= '0;
    else if (reads) row_q <= row_q + RowWidth'(1);
  end

  // ---- the factor N / T
  localparam int unsigned ZerosWidth = $clog2(SumWidth);
  logic [ZerosWidth-1:0] zeros;
  logic [17:0] reciprocal;
  logic [At+18:0] product_n;
  (* keep *) logic [23:0] factor_q;  // in flip-flops of its own: the product before it keeps its register
  logic [23:0] uniform_q;
  logic [At:0] all_n;
  assign all_n = n_i << $clog2(Lanes);
  always_ff @(posedge clk_i) if (total_valid_i) uniform_q <= uniform_i;
  mote_reciprocal #(.Width(SumWidth), .MostZeros(At + 7), .Product(Product)) u_reciprocal (
      .clk_i, .load_i(total_valid_i), .divisor_i(total_i), .zeros_o(zeros), .reciprocal_o(reciprocal));
  mote_times #(.AWidth(18), .BWidth(At + 1), .Product(Product)) u_product_n (
      .clk_i, .a_i(reciprocal), .b_i(all_n), .p_o(product_n));
  always_ff @(posedge clk_i) factor_q <= product_n[Drop+:24];
  logic unused_product;
  assign unused_product = ^product_n;

  // ---- weights as parts of the total
  logic [RowWidth:0] faint_before;
  logic [2:0] level;
  logic [5:0] by;
  logic [6:0] mask;
  logic [1:0] faint;  // slots of the row
  mote_scales #(.At(At), .SlotWidth(RowWidth + 1), .ZerosWidth(ZerosWidth)) u_scales (
      .clk_i, .write_i, .last_i, .slot_i(written_q[RowWidth:0]), .rise_i, .scale_i, .zeros_i(zeros),
      .faint_before_o(faint_before), .level_o(level), .by_o(by), .mask_o(mask));
  mote_delay #(.Width(2), .Depth(2)) u_faint (
      .clk_i, .d_i({{row_q, 1'b1} < faint_before, {row_q, 1'b0} < faint_before}), .d_o(faint));

  // ---- cumulative sums: in the row, added to those before
  logic [(Levels+1)*Many*Width-1:0] sums;  // level after level
  logic [Many*42-1:0] place_q;
  logic [Width-1:0] base_q;
  logic summed;
  mote_valid #(.Depth(5 + Levels)) u_summed (.clk_i, .rst_ni, .valid_i(reads), .valid_o(summed));
  for (genvar i = 0; i < Many; i++) begin : gen_particle
    logic [Width-1:0] cum_q;
    logic [40:0] product;
    mote_times #(.AWidth(24), .BWidth(17), .Product(Product)) u_product (
        .clk_i, .a_i(factor_q), .b_i(cum_q[Width-1-:17]), .p_o(product));
    mote_share #(.Width(Width)) u_share (
        .clk_i, .short_i(word[i*18+:18]), .faint_i(faint[i/Lanes]), .by_i(by), .level_i(level), .mask_i(mask),
        .share_o(sums[i*Width+:Width]));
    always_ff @(posedge clk_i) begin
      cum_q <= base_q + sums[(Levels*Many+i)*Width+:Width];
      place_q[i*42+:42] <= 42'(product) + 42'({uniform_q, {(Frac - 24) {1'b0}}});
    end
    logic unused_bits;
    assign unused_bits = ^cum_q[Width-18:0];
    for (genvar k = 0; k < Levels; k++) begin : gen_level
      localparam int unsigned Here = (k * Many + i) * Width;
      logic [Width-1:0] sum_q;
      if (i >= (1 << k)) begin : gen_sum
        always_ff @(posedge clk_i) sum_q <= sums[Here+:Width] + sums[Here-(Width<<k)+:Width];
      end else begin : gen_copy
        always_ff @(posedge clk_i) sum_q <= sums[Here+:Width];
      end
      assign sums[Here+Many*Width+:Width] = sum_q;
    end
  end
  always_ff @(posedge clk_i) begin
    if (last_i) base_q <= '0;
    else if (summed) base_q <= base_q + sums[(Levels+1)*Many*Width-1-:Width];
  end

  // ---- ends; rows without children are left out
  logic last_ends, lone_ends, last_before, lone_before;
  row_t row_ends;
  count_t before_q;
  logic [Many*(At+1)-1:0] ends;
  count_t row_end;
  assign row_end = ends[Many*(At+1)-1-:At+1];
  mote_valid #(.Depth(Latency)) u_arrives (.clk_i, .rst_ni, .valid_i(reads), .valid_o(arrives));
  mote_delay #(.Width(RowWidth), .Depth(Latency)) u_row (.clk_i, .d_i(row_q), .d_o(row_ends));
  mote_delay #(.Width(2), .Depth(Latency - 1)) u_last (
      .clk_i, .d_i({last_row, last_row && n_i[0]}), .d_o({last_before, lone_before}));
  always_ff @(posedge clk_i or negedge rst_ni) begin  // a reset keeps them out of a slow shift register
    if (!rst_ni) {last_ends, lone_ends} <= '0;
    else {last_ends, lone_ends} <= {last_before, lone_before};
  end
  always_comb begin
    for (int i = 0; i < Many; i++) begin
      ends[i*(At+1)+:At+1] = place_q[i*42+Frac+:At+1];
      if (last_ends && (i == Many - 1 || lone_ends && i + 1 >= Lanes)) ends[i*(At+1)+:At+1] = all_n;
    end
  end
  assign left_out = arrives && row_end == before_q;
  assign push = arrives && row_end != before_q;
  always_ff @(posedge clk_i) begin
    if (last_i) before_q <= '0;
    else if (arrives) before_q <= row_end;
  end
  logic no_row, unused_full;
  mote_fifo #(.Width(Many * (At + 1) + RowWidth), .Depth(Rows)) u_rows (
      .clk_i, .rst_ni, .clear_i(drop_i),
      .push_i(push), .word_i({row_ends, ends}),
      .pop_i, .word_o({row_o, ends_o}), .empty_o(no_row), .full_o(unused_full));
  assign valid_o = !no_row;
endmodule
