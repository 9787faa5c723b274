// The bootstrap filter, one lane, merged and overlapped: propagate, weigh and sum in one pass; the resampling of a step
// walks beside the propagation of the next.
//
//   x' ~ p(. | x_a(j)),  lw = log2 p(y | x'),  a(j) by systematic resampling (mote_systematic), every step
//   mean = sum w x' / sum w, before resampling
//
// The arithmetic of a model is outside, as for mote_imh. t_o and obs_o stand from 3 cycles before the first state of a
// step reaches propose until its last leaves weigh. At t = 1 the parent's state is undefined.
//
// formats  states: Dims signed words of ValueWidth bits; log weights: signed, octaves, 10 fraction bits
// range    1 <= n_i <= 2^At, At >= 2. Registers are read at start_i
// timing   a particle a cycle, as long as the walk has parents; a step's first parents are there 15 cycles after its last
//          state left weigh, or when its first row with children is reached. The golden model counts cycles exactly
// golden   mote/hardware/filters/sisr.hpp
// source   FPGA (merged loops, dataflow); Kitagawa 1996
module mote_sisr #(
    parameter int unsigned Dims           = 1,
    parameter int unsigned ValueWidth     = 18,
    parameter int unsigned ObsWidth       = 32,
    parameter int unsigned DrawWords      = 1,
    parameter int unsigned LogWidth       = 24,
    parameter int unsigned WeightWidth    = 24,
    parameter int unsigned Extra          = 8,
    parameter int unsigned At             = 10,
    parameter int unsigned ProposeLatency = 4,
    parameter int unsigned WeighLatency   = 4,
    parameter logic [63:0] Seed           = 64'd1,
    parameter int unsigned Stream         = 0,
    parameter Exp2Table                   = "exp2.hex",
    localparam int unsigned ScaleWidth = LogWidth - 12,
    localparam int unsigned SumWidth   = WeightWidth + At,
    localparam int unsigned MeanWidth  = ValueWidth + Extra + 1,
    localparam int unsigned StateWidth = Dims * ValueWidth
) (
    input  logic                                   clk_i,
    input  logic                                   rst_ni,
    // registers
    input  logic                                   start_i,
    input  logic        [At:0]                     n_i,
    input  logic        [15:0]                     steps_i,
    output logic                                   busy_o,
    // observations, AXI4-Stream
    input  logic                                   obs_valid_i,
    output logic                                   obs_ready_o,
    input  logic        [ObsWidth-1:0]             obs_i,
    // the model
    output logic        [15:0]                     t_o,
    output logic        [ObsWidth-1:0]             obs_o,
    output logic                                   propose_valid_o,
    output logic        [StateWidth-1:0]           propose_state_o,
    output logic        [DrawWords-1:0][31:0]      propose_words_o,
    input  logic        [StateWidth-1:0]           propose_state_i,
    output logic                                   weigh_valid_o,
    output logic        [StateWidth-1:0]           weigh_state_o,
    input  logic signed [LogWidth-1:0]             weigh_log_i,
    // the set before resampling, as it is written
    output logic                                   kept_valid_o,
    output logic        [At-1:0]                   kept_slot_o,
    output logic        [StateWidth-1:0]           kept_state_o,
    // estimates, AXI4-Stream
    output logic                                   est_valid_o,
    input  logic                                   est_ready_i,
    output logic                                   est_last_o,
    output logic        [Dims-1:0][MeanWidth-1:0]  est_mean_o,
    output logic        [SumWidth-1:0]             est_sum_o,
    output logic signed [ScaleWidth-1:0]           est_scale_o
);
  typedef logic [At:0] count_t;

  // ---- steps: each begins when the model has weighed the one before, with an observation at hand
  count_t n_q, issued_q, weighed_q;
  logic next_valid_q, begins, idle_q, weighed_valid, weighed_last, issues, first_q;
  logic [ObsWidth-1:0] next_obs_q;
  logic [1:0] out_q;
  logic [15:0] left_q;
  logic est_taken, parent_valid;
  logic [At-1:0] parent;
  assign est_taken = est_valid_o && est_ready_i;
  assign begins = (idle_q || weighed_last) && left_q != '0 && next_valid_q && !out_q[1];
  assign obs_ready_o = !next_valid_q;
  assign issues = issued_q != n_q && (first_q || parent_valid);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_o       <= 1'b0;
      left_q       <= '0;
      next_valid_q <= 1'b0;
      idle_q       <= 1'b1;
      out_q        <= '0;
      t_o          <= '0;
      n_q          <= '0;
      issued_q     <= '0;
      first_q      <= 1'b0;
    end else begin
      if (start_i && !busy_o) begin
        busy_o   <= steps_i != '0;
        left_q   <= steps_i;
        t_o      <= '0;
        n_q      <= n_i;
        issued_q <= n_i;
        first_q  <= 1'b1;
      end else begin
        if (est_taken && est_last_o) busy_o <= 1'b0;
        if (begins) begin
          left_q   <= left_q - 16'd1;
          t_o      <= t_o + 16'd1;
          first_q  <= t_o == '0;
          issued_q <= '0;
        end else if (issues) begin
          issued_q <= issued_q + count_t'(1);
        end
      end
      if (obs_valid_i && obs_ready_o) next_valid_q <= 1'b1;
      else if (begins) next_valid_q <= 1'b0;
      if (begins) idle_q <= 1'b0;
      else if (weighed_last) idle_q <= 1'b1;
      out_q <= out_q + 2'(begins) - 2'(est_taken);
    end
  end
  always_ff @(posedge clk_i) begin
    if (obs_valid_i && obs_ready_o) next_obs_q <= obs_i;
    if (begins) obs_o <= next_obs_q;
  end

  // ---- particles
  logic [At-1:0] parent_q, slot_q;
  logic bank_q, read_bank_q;
  logic [StateWidth-1:0] parent_state;
  always_ff @(posedge clk_i) begin
    parent_q <= parent;
    read_bank_q <= ~bank_q;
  end
  mote_ram #(.Width(StateWidth), .Words(2 << At)) u_set (
      .clk_i,
      .write_i(kept_valid_o),
      .write_at_i({bank_q, slot_q}),
      .write_word_i(kept_state_o),
      .read_at_i({read_bank_q, parent_q}),
      .read_word_o(parent_state));

  // ---- the model's arithmetic
  mote_valid #(.Depth(3)) u_propose_valid (.clk_i, .rst_ni, .valid_i(issues), .valid_o(propose_valid_o));
  assign propose_state_o = parent_state;
  for (genvar w = 0; w < DrawWords; w++) begin : gen_words
    mote_words #(.Seed(Seed), .Stream(Stream + 1 + w)) u_words (
        .clk_i, .rst_ni, .advance_i(propose_valid_o), .word_o(propose_words_o[w]));
  end
  mote_valid #(.Depth(ProposeLatency)) u_weigh_valid (
      .clk_i, .rst_ni, .valid_i(propose_valid_o), .valid_o(weigh_valid_o));
  assign weigh_state_o = propose_state_i;
  mote_valid #(.Depth(WeighLatency)) u_weighed_valid (
      .clk_i, .rst_ni, .valid_i(weigh_valid_o), .valid_o(weighed_valid));
  mote_delay #(.Width(StateWidth), .Depth(WeighLatency + 5)) u_state (
      .clk_i, .d_i(propose_state_i), .d_o(kept_state_o));
  assign weighed_last = weighed_valid && weighed_q + count_t'(1) == n_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) weighed_q <= '0;
    else if (weighed_valid) weighed_q <= weighed_last ? '0 : weighed_q + count_t'(1);
  end

  // ---- weights
  logic weight_first, kept_last;
  logic [2:0] weight_rise;
  logic [WeightWidth-1:0] weight;
  logic signed [ScaleWidth-1:0] scale, scale_early;
  mote_weight #(.LogWidth(LogWidth), .Width(WeightWidth), .Table(Exp2Table)) u_weight (
      .clk_i, .rst_ni,
      .valid_i(weighed_valid),
      .first_i(weighed_q == '0),
      .log_weight_i(weigh_log_i),
      .valid_o(kept_valid_o),
      .first_o(weight_first),
      .rise_o(weight_rise),
      .weight_o(weight),
      .scale_o(scale),
      .scale_early_o(scale_early));
  assign kept_slot_o = slot_q;
  assign kept_last = kept_valid_o && {1'b0, slot_q} + count_t'(1) == n_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      slot_q <= '0;
      bank_q <= 1'b0;
    end else if (kept_valid_o) begin
      slot_q <= kept_last ? '0 : slot_q + At'(1);
      bank_q <= bank_q ^ kept_last;
    end
  end

  // ---- resampling
  logic scale_known, total_valid_q;
  logic [SumWidth-1:0] total;
  logic [31:0] resample_word;
  logic unused_word;
  assign unused_word = ^resample_word[7:0];
  mote_valid #(.Depth(2)) u_scale_known (.clk_i, .rst_ni, .valid_i(weighed_last), .valid_o(scale_known));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) total_valid_q <= 1'b0;
    else total_valid_q <= kept_last;
  end
  mote_words #(.Seed(Seed), .Stream(Stream)) u_resample_words (
      .clk_i, .rst_ni, .advance_i(total_valid_q), .word_o(resample_word));
  mote_systematic #(.At(At), .Width(WeightWidth), .ScaleWidth(ScaleWidth)) u_systematic (
      .clk_i, .rst_ni,
      .drop_i(start_i && !busy_o),
      .n_i(n_q),
      .write_i(kept_valid_o),
      .weight_i(weight),
      .scale_i(scale),
      .scale_known_i(scale_known),
      .last_scale_i(scale_early),
      .total_valid_i(total_valid_q),
      .total_i(total),
      .uniform_i(resample_word[31:8]),
      .valid_o(parent_valid),
      .ready_i(issued_q != n_q && !first_q),
      .parent_o(parent));

  // ---- estimates
  logic [15:0] estimates_left_q;
  logic unused_pending;
  logic [At:0] unused_accepted;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) estimates_left_q <= '0;
    else if (start_i && !busy_o) estimates_left_q <= steps_i;
    else if (kept_last) estimates_left_q <= estimates_left_q - 16'd1;
  end
  mote_estimate #(
      .Dims(Dims), .ValueWidth(ValueWidth), .Width(WeightWidth), .At(At), .Extra(Extra), .ScaleWidth(ScaleWidth)
  ) u_estimate (
      .clk_i, .rst_ni,
      .weight_valid_i(kept_valid_o),
      .weight_first_i(weight_first),
      .weight_rise_i(weight_rise),
      .weight_i(weight),
      .scale_i(scale),
      .sum_so_far_o(total),
      .value_valid_i(kept_valid_o),
      .value_first_i(weight_first),
      .value_rise_i(weight_rise),
      .value_weight_i(weight),
      .value_i(kept_state_o),
      .done_i(kept_last),
      .last_i(estimates_left_q == 16'd1),
      .equal_i(1'b0),
      .count_i(n_q),
      .accepted_i('0),
      .pending_o(unused_pending),
      .valid_o(est_valid_o),
      .ready_i(est_ready_i),
      .last_o(est_last_o),
      .mean_o(est_mean_o),
      .sum_o(est_sum_o),
      .scale_o(est_scale_o),
      .accepted_o(unused_accepted));
endmodule
