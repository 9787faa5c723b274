// Systematic resampling that walks beside the next step's propagation: two weights a cycle, no division.
//
//   parent of child j: the least i with  N (w_0 + ... + w_i) > u T + j T,   T = sum w,  u ~ U[0, 1) of 24 bits
//
// Weights are stored with the scale that they were made at and lowered to the last one's when they are read. The last
// particle takes the children that truncation leaves.
//
// formats  weights: unsigned; cumulative sums and thresholds: exact integers
// range    1 <= n_i <= 2^At; sums and thresholds stay below 2^(Width + 2 At + 3)
// timing   rows of two weights are read from the cycle after scale_known_i (the last scale of the step), the walk begins
//          3 cycles after total_valid_i; up to two children a cycle, a row without children costs a cycle. Queues of
//          Rows rows and Parents entries let it run ahead
// golden   mote/hardware/filters/systematic.hpp
// source   Kitagawa 1996 (systematic resampling)
module mote_systematic #(
    parameter int unsigned At         = 10,
    parameter int unsigned Width      = 24,
    parameter int unsigned ScaleWidth = 12,
    parameter int unsigned Rows       = 16,
    parameter int unsigned Parents    = 128,
    localparam int unsigned SumWidth  = Width + At
) (
    input  logic                         clk_i,
    input  logic                         rst_ni,
    input  logic                         drop_i,  // what a run left, before another
    input  logic        [At:0]           n_i,
    // weights, slot after slot
    input  logic                         write_i,
    input  logic        [Width-1:0]      weight_i,
    input  logic signed [ScaleWidth-1:0] scale_i,
    // the end of a step
    input  logic                         scale_known_i,
    input  logic signed [ScaleWidth-1:0] last_scale_i,
    input  logic                         total_valid_i,
    input  logic        [SumWidth-1:0]   total_i,
    input  logic        [23:0]           uniform_i,
    // parents, child after child
    output logic                         valid_o,
    input  logic                         ready_i,
    output logic        [At-1:0]         parent_o
);
  localparam int unsigned WordWidth = Width + ScaleWidth;
  localparam int unsigned CumWidth = Width + 2 * At + 3;
  typedef logic [CumWidth-1:0] cum_t;
  typedef logic [At-1:0] row_t;

  logic clears;
  assign clears = scale_known_i || drop_i;

  // ---- memory of weights, even and odd slots, two banks
  logic [At:0] written_q;
  logic bank_q, read_bank_q, all_q, last_write;
  assign last_write = write_i && written_q + (At + 1)'(1) == n_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      written_q <= '0;
      bank_q <= 1'b0;
      all_q <= 1'b0;
    end else begin
      if (write_i) written_q <= last_write ? '0 : written_q + (At + 1)'(1);
      if (last_write) bank_q <= ~bank_q;
      if (last_write) all_q <= 1'b1;
      else if (scale_known_i) all_q <= 1'b0;
    end
  end
  row_t row_q;
  logic [2*WordWidth-1:0] word;
  for (genvar h = 0; h < 2; h++) begin : gen_half
    mote_ram #(.Width(WordWidth), .Words(1 << At)) u_weights (
        .clk_i,
        .write_i(write_i && written_q[0] == 1'(h)),
        .write_at_i({bank_q, written_q[At-1:1]}),
        .write_word_i({scale_i, weight_i}),
        .read_at_i({read_bank_q, row_q[At-2:0]}),
        .read_word_o(word[h*WordWidth+:WordWidth]));
  end

  // ---- reading, as far as it is written and the queue has room
  logic reads_q, reads, pop, last_row;
  logic [$clog2(Rows):0] room_q;
  logic signed [ScaleWidth-1:0] last_scale_q;
  logic [At:0] needed;
  assign needed = {row_q, 1'b1};
  assign last_row = row_q == At'((n_i - (At + 1)'(1)) >> 1);
  assign reads = reads_q && room_q != '0 && (all_q || needed < written_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      reads_q <= 1'b0;
      room_q  <= ($clog2(Rows) + 1)'(Rows);
    end else if (clears) begin
      reads_q <= scale_known_i;
      room_q  <= ($clog2(Rows) + 1)'(Rows);
    end else begin
      if (reads && last_row) reads_q <= 1'b0;
      room_q <= room_q - ($clog2(Rows) + 1)'(reads) + ($clog2(Rows) + 1)'(pop);
    end
  end
  always_ff @(posedge clk_i) begin
    if (scale_known_i) begin
      row_q <= '0;
      read_bank_q <= bank_q;
      last_scale_q <= last_scale_i;
    end else if (reads) row_q <= row_q + At'(1);
  end
  logic read7, last6, lone6;
  mote_valid #(.Depth(7)) u_read (.clk_i, .rst_ni, .valid_i(reads), .valid_o(read7));
  mote_delay #(.Width(2), .Depth(6)) u_last (
      .clk_i, .d_i({last_row, last_row && n_i[0]}), .d_o({last6, lone6}));

  // ---- lowered to the last scale, times N, summed
  logic [SumWidth:0] product2[2];
  logic [SumWidth+1:0] both_q;
  logic [SumWidth:0] even_q;
  cum_t base_q, even_sum_q, odd_sum_q;
  logic read6;
  mote_valid #(.Depth(6)) u_read6 (.clk_i, .rst_ni, .valid_i(reads), .valid_o(read6));
  function automatic logic [Width-1:0] lowered(input logic [WordWidth-1:0] stored,
                                               input logic signed [ScaleWidth-1:0] last);
    logic [ScaleWidth-1:0] by;
    by = last - $signed(stored[WordWidth-1:Width]);
    lowered = by > ScaleWidth'(7) ? '0 : stored[Width-1:0] >> {by[2:0], 3'b0};
  endfunction
  for (genvar h = 0; h < 2; h++) begin : gen_product
    logic [Width-1:0] lowered_q;
    logic [SumWidth:0] product_q, product2_q;
    always_ff @(posedge clk_i) begin
      lowered_q  <= lowered(word[h*WordWidth+:WordWidth], last_scale_q);
      product_q  <= (SumWidth + 1)'(lowered_q) * (SumWidth + 1)'(n_i);
      product2_q <= product_q;
    end
    assign product2[h] = product2_q;
  end
  always_ff @(posedge clk_i) begin
    both_q <= (SumWidth + 2)'(product2[0]) + (SumWidth + 2)'(product2[1]);
    even_q <= product2[0];
    if (scale_known_i) base_q <= '0;
    else if (read6) base_q <= base_q + CumWidth'(both_q);
    even_sum_q <= lone6 ? '1 : base_q + CumWidth'(even_q);
    odd_sum_q  <= last6 ? '1 : base_q + CumWidth'(both_q);
  end
  cum_t even_sum, odd_sum;
  logic no_row, unused_full;
  mote_fifo #(.Width(2 * CumWidth), .Depth(Rows)) u_rows (
      .clk_i, .rst_ni, .clear_i(clears),
      .push_i(read7), .word_i({even_sum_q, odd_sum_q}),
      .pop_i(pop), .word_o({even_sum, odd_sum}), .empty_o(no_row), .full_o(unused_full));

  // ---- the walk
  logic [23:0] uniform_q;
  logic [SumWidth-1:0] total_q, start_q;
  logic [1:0] total_valid_q;
  logic walks_q;
  logic [At:0] left_q;
  cum_t t0_q, t1_q, t2_q;
  row_t walk_row_q;
  logic goes, one, two, no_parent, full;
  assign goes = walks_q && !no_row && !full;
  assign one = odd_sum > t0_q;
  assign two = odd_sum > t1_q && left_q != (At + 1)'(1);
  assign pop = goes && !(two && odd_sum > t2_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      total_valid_q <= '0;
      walks_q <= 1'b0;
    end else begin
      total_valid_q <= {total_valid_q[0], total_valid_i};
      if (clears) walks_q <= 1'b0;
      else if (total_valid_q[1]) walks_q <= 1'b1;
      else if (goes && one && left_q <= (two ? (At + 1)'(2) : (At + 1)'(1))) walks_q <= 1'b0;
    end
  end
  always_ff @(posedge clk_i) begin
    if (total_valid_i) begin
      total_q   <= total_i;
      uniform_q <= uniform_i;
    end
    start_q <= SumWidth'((SumWidth + 24)'(total_q) * (SumWidth + 24)'(uniform_q) >> 24);
    if (total_valid_q[1]) begin
      t0_q   <= CumWidth'(start_q);
      t1_q   <= CumWidth'(start_q) + CumWidth'(total_q);
      t2_q   <= CumWidth'(start_q) + (CumWidth'(total_q) << 1);
      left_q <= n_i;
    end else if (goes && one) begin
      t0_q   <= two ? t2_q : t1_q;
      t1_q   <= two ? t2_q + CumWidth'(total_q) : t2_q;
      t2_q   <= t2_q + (two ? CumWidth'(total_q) << 1 : CumWidth'(total_q));
      left_q <= left_q - (two ? (At + 1)'(2) : (At + 1)'(1));
    end
    if (scale_known_i) walk_row_q <= '0;
    else if (pop) walk_row_q <= walk_row_q + At'(1);
  end

  // ---- parents: up to two an entry
  logic [At-2:0] parent_row;
  logic pair, first_odd, second_odd, second_q;
  mote_fifo #(.Width(At + 2), .Depth(Parents)) u_parents (
      .clk_i, .rst_ni, .clear_i(clears),
      .push_i(goes && one),
      .word_i({walk_row_q[At-2:0], two, !(even_sum > t0_q), !(even_sum > t1_q)}),
      .pop_i(valid_o && ready_i && (second_q || !pair)),
      .word_o({parent_row, pair, first_odd, second_odd}), .empty_o(no_parent), .full_o(full));
  assign valid_o = !no_parent;
  assign parent_o = {parent_row, second_q ? second_odd : first_odd};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) second_q <= 1'b0;
    else if (clears) second_q <= 1'b0;
    else if (valid_o && ready_i) second_q <= pair && !second_q;
  end
endmodule
