// A systematic resampler by itself: the log weights of a set come in, the parents of its children go out.
//
//   parent of child j: the first i with  floor(C_i N / T + v) > j,  C_i = w_0 + ... + w_i,  T = sum w,  v ~ U[0, 1)
//
// formats  log_weight_i: signed, LogWidth bits, 10 fraction bits, octaves; parent_o: unsigned
// range    1 <= n_i <= 2^At, standing from the first weight of a set until its last parent has left; At >= 6
// timing   streams: a weight a clock until the set is complete, then parents, up to one a clock (a row of two particles without
//          children costs a cycle); the next set is taken when the last parent has left
// seeding  uniform words from Seed; a reset begins them anew
// golden   resampled() in mote/hardware/machine/accelerator.hpp
// source   Kitagawa 1996 (systematic resampling); PPF section 3.5
module mote_resample_stream #(
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
  localparam logic [At:0] One = (At + 1)'(1);

  // ---- a set's weights in, then its parents out
  count_t taken_q, kept_q, left_q;
  logic takes, takes_q, first_q, leaves, kept_valid, kept_last;
  logic [LogWidth-1:0] log_q;
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
  logic [1:0] rise;
  logic [Width-1:0] weight;
  logic [SumWidth-1:0] sum_q;
  logic signed [ScaleWidth-1:0] scale;
  mote_weight #(.LogWidth(LogWidth), .Width(Width), .Table(Exp2Table)) u_weight (
      .clk_i, .rst_ni,
      .valid_i(takes_q),
      .first_i(first_q),
      .log_weight_i(log_q),
      .valid_o(kept_valid),
      .rise_o(rise),
      .weight_o(weight),
      .scale_o(scale));
  always_ff @(posedge clk_i) begin
    log_q   <= log_weight_i;
    first_q <= taken_q == '0;
    if (kept_valid) sum_q <= (rise == 2'd3 ? '0 : sum_q >> {rise, 3'b0}) + SumWidth'(weight);
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) takes_q <= 1'b0;
    else takes_q <= takes;
  end

  // ---- the walk
  logic walk_valid;
  assign parent_valid_o = walk_valid && left_q != '0;
  mote_resample #(.At(At), .Width(Width), .ScaleWidth(ScaleWidth), .Seed(Seed)) u_resample (
      .clk_i, .rst_ni,
      .starts_i(takes && taken_q == '0),
      .n_i,
      .write_i(kept_valid),
      .last_i(kept_last),
      .weight_i(weight),
      .scale_i(scale),
      .total_i(sum_q),
      .more_i(1'b1),
      .valid_o(walk_valid),
      .ready_i(leaves),
      .parent_o);
endmodule
