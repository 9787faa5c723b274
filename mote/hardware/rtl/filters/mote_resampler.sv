// A systematic resampler by itself: the log weights of a set come in, the parents of its children go out.
//
//   parent of child j: the least i with  w_0 + ... + w_i > (u + j) T / N,   T = sum w,  u ~ U[0, 1) of 24 bits
//
// formats  log_weight_i: signed, LogWidth bits, 10 fraction bits, octaves; parent_o: unsigned
// range    1 <= n_i <= 2^At, standing from the first weight of a set until its last parent has left; At >= 2
// timing   streams: a weight a clock until the set is complete, then parents, up to one a clock (a row of two particles without
//          children costs a cycle); the next set is taken when the last parent has left
// seeding  uniform words from Seed; a reset begins them anew
// golden   resampled() in mote/hardware/machine/accelerator.hpp
// source   Kitagawa 1996 (systematic resampling); PPF section 3.5
module mote_resampler #(
    parameter int unsigned At       = 10,
    parameter int unsigned LogWidth = 24,
    parameter int unsigned Width    = 24,
    parameter logic [63:0] Seed     = 64'd1,
    parameter Exp2Table             = "exp2.hex",
    localparam int unsigned ScaleWidth = LogWidth - 12,
    localparam int unsigned SumWidth   = Width + At
) (
    input  logic                clk_i,
    input  logic                rst_ni,
    input  logic [At:0]         n_i,
    // log weights, particle after particle
    input  logic                log_valid_i,
    output logic                log_ready_o,
    input  logic [LogWidth-1:0] log_weight_i,
    // parents, child after child
    output logic                parent_valid_o,
    input  logic                parent_ready_i,
    output logic [At-1:0]       parent_o,
    output logic                parent_last_o
);
  typedef logic [At:0] count_t;
  localparam count_t One = count_t'(1);

  // ---- a set's weights in, then its parents out
  count_t taken_q, kept_q, left_q;
  logic takes, leaves, kept_valid, kept_first, kept_last;
  assign log_ready_o = taken_q != n_i && left_q == '0;
  assign takes = log_valid_i && log_ready_o;
  assign leaves = parent_valid_o && parent_ready_i;
  assign kept_last = kept_valid && kept_q + One == n_i;
  assign parent_last_o = left_q == One;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {taken_q, kept_q, left_q} <= '0;
    else begin
      if (leaves && parent_last_o) taken_q <= '0;
      else if (takes) taken_q <= taken_q + One;
      if (kept_valid) kept_q <= kept_last ? '0 : kept_q + One;
      if (kept_last) left_q <= n_i;
      else if (leaves) left_q <= left_q - One;
    end
  end

  // ---- weights and their sum at the last scale
  logic [2:0] rise;
  logic [Width-1:0] weight;
  logic [SumWidth-1:0] sum_q;
  logic signed [ScaleWidth-1:0] scale, unused_early;
  logic done_q;
  mote_weight #(.LogWidth(LogWidth), .Width(Width), .Table(Exp2Table)) u_weight (
      .clk_i, .rst_ni,
      .valid_i(takes),
      .first_i(taken_q == '0),
      .log_weight_i,
      .valid_o(kept_valid),
      .first_o(kept_first),
      .rise_o(rise),
      .weight_o(weight),
      .scale_o(scale),
      .scale_early_o(unused_early));
  always_ff @(posedge clk_i)
    if (kept_valid) sum_q <= (kept_first ? '0 : sum_q >> {rise, 3'b0}) + SumWidth'(weight);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) done_q <= 1'b0;
    else done_q <= kept_last;
  end

  // ---- the walk
  logic walk_valid, unused_word;
  logic [31:0] word;
  assign unused_word = ^word[7:0];
  assign parent_valid_o = walk_valid && left_q != '0;
  mote_words #(.Seed(Seed), .Stream(0)) u_words (.clk_i, .rst_ni, .advance_i(done_q), .word_o(word));
  mote_systematic #(.At(At), .Width(Width), .ScaleWidth(ScaleWidth)) u_systematic (
      .clk_i, .rst_ni,
      .drop_i(takes && taken_q == '0),
      .n_i,
      .write_i(kept_valid),
      .weight_i(weight),
      .scale_i(scale),
      .scale_known_i(kept_last),
      .last_scale_i(scale),
      .total_valid_i(done_q),
      .total_i(sum_q),
      .uniform_i(word[31:8]),
      .valid_o(walk_valid),
      .ready_i(leaves),
      .parent_o);
endmodule
