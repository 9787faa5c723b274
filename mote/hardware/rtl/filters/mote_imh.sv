// The filter without resampling, one chain: independent Metropolis-Hastings over proposals from the mixture of parents.
//
//   for j = 0 .. Q + N_b - 1:   i ~ U{0 .. N - 1},  x' ~ p(. | x_i),  lw' = log2 p(y | x')
//   accept x' after x   iff   j = 0  or  lw <= lw' - log2 u
//   keeps the last N states of the chain; mean over all proposals by weight, or over the kept states (chain_mean_i)
//
// The arithmetic of a model is outside, pipelines without stalls: propose (state_i, words -> state, ProposeLatency
// cycles) and weigh (state -> log weight, WeighLatency cycles). t_o and obs_o stand from 4 cycles before the first
// state of a step reaches propose until its last leaves weigh. At t = 1 the parent's state is undefined: propose draws
// it from the prior.
//
// formats  states: Dims signed words of ValueWidth bits; log weights: signed, octaves, 10 fraction bits
// range    1 <= n_i <= Most; n_i <= draws_i; draws_i + burn_in_i <= 2^At; Most <= 2^At. Registers are read at start_i
// timing   a step takes (N_b + Q - 1) + K_p + K_w + 1 cycles, exactly (IMH-HW 5.3 with T_p = T_w = T_D = 1):
//          K_p = 4 + ProposeLatency, K_w = WeighLatency + 1; the estimate follows 9 + Dims (ValueWidth + Extra + 1)
//          cycles behind the last decision. It waits for an observation, and for the estimate of the step before the
//          last to be taken. ProposeLatency + WeighLatency >= 6
// golden   mote/hardware/filters/imh.hpp
// source   IMH-HW fig. 2 and (16) - (17)
module mote_imh #(
    parameter int unsigned Dims           = 1,
    parameter int unsigned ValueWidth     = 18,
    parameter int unsigned ObsWidth       = 32,
    parameter int unsigned DrawWords      = 1,
    parameter int unsigned LogWidth       = 24,
    parameter int unsigned WeightWidth    = 24,
    parameter int unsigned Extra          = 8,
    parameter int unsigned Most           = 1024,
    parameter int unsigned At             = 12,
    parameter int unsigned ProposeLatency = 4,
    parameter int unsigned WeighLatency   = 4,
    parameter logic [63:0] Seed           = 64'd1,
    parameter int unsigned Stream         = 0,
    parameter Exp2Table                   = "exp2.hex",
    parameter Log2Table                   = "log2.hex",
    localparam int unsigned ScaleWidth = LogWidth - 12,
    localparam int unsigned SumWidth   = WeightWidth + At,
    localparam int unsigned MeanWidth  = ValueWidth + Extra + 1,
    localparam int unsigned StateWidth = Dims * ValueWidth,
    localparam int unsigned SlotWidth  = $clog2(Most)
) (
    input  logic                                   clk_i,
    input  logic                                   rst_ni,
    // registers
    input  logic                                   start_i,
    input  logic        [At:0]                     n_i,
    input  logic        [At:0]                     draws_i,
    input  logic        [At:0]                     burn_in_i,
    input  logic        [15:0]                     steps_i,
    input  logic                                   chain_mean_i,
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
    // the set, as it is written
    output logic                                   kept_valid_o,
    output logic        [SlotWidth-1:0]            kept_slot_o,
    output logic        [StateWidth-1:0]           kept_state_o,
    // estimates, AXI4-Stream
    output logic                                   est_valid_o,
    input  logic                                   est_ready_i,
    output logic                                   est_last_o,
    output logic        [Dims-1:0][MeanWidth-1:0]  est_mean_o,
    output logic        [SumWidth-1:0]             est_sum_o,
    output logic signed [ScaleWidth-1:0]           est_scale_o,
    output logic        [At:0]                     est_accepted_o
);
  localparam int unsigned ModelLatency = ProposeLatency + WeighLatency;
  typedef logic [At:0] count_t;

  // ---- what a run is
  count_t n_q, total_q, drop_q;
  logic equal_q;
  logic [15:0] left_q;
  always_ff @(posedge clk_i) begin
    if (start_i && !busy_o) begin
      n_q     <= n_i;
      total_q <= draws_i + burn_in_i;
      drop_q  <= draws_i + burn_in_i - n_i;
      equal_q <= chain_mean_i;
    end
  end

  // ---- steps: each begins when the one before has decided all, with an observation at hand
  logic next_valid_q, begins, issues_q, free, decided_last, idle_q;
  logic [ObsWidth-1:0] next_obs_q;
  logic [1:0] out_q;
  count_t issue_q;
  logic est_taken;
  assign est_taken = est_valid_o && est_ready_i;
  assign free = idle_q || decided_last;
  assign begins = free && left_q != '0 && next_valid_q && !out_q[1];
  assign obs_ready_o = !next_valid_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_o       <= 1'b0;
      left_q       <= '0;
      next_valid_q <= 1'b0;
      issues_q     <= 1'b0;
      idle_q       <= 1'b1;
      out_q        <= '0;
      t_o          <= '0;
    end else begin
      if (start_i && !busy_o) begin
        busy_o <= steps_i != '0;
        left_q <= steps_i;
        t_o    <= '0;
      end else if (est_taken && est_last_o) begin
        busy_o <= 1'b0;
      end
      if (obs_valid_i && obs_ready_o) next_valid_q <= 1'b1;
      else if (begins) next_valid_q <= 1'b0;
      if (begins) begin
        left_q   <= left_q - 16'd1;
        t_o      <= t_o + 16'd1;
        issues_q <= 1'b1;
      end else if (issue_q + count_t'(1) == total_q) begin
        issues_q <= 1'b0;
      end
      if (begins) idle_q <= 1'b0;
      else if (decided_last) idle_q <= 1'b1;
      out_q <= out_q + 2'(begins) - 2'(est_taken);
    end
  end
  always_ff @(posedge clk_i) begin
    if (obs_valid_i && obs_ready_o) next_obs_q <= obs_i;
    if (begins) obs_o <= next_obs_q;
    if (begins) issue_q <= '0;
    else if (issues_q) issue_q <= issue_q + count_t'(1);
  end

  // ---- parents: slot = floor(u N), u of 24 bits
  logic [31:0] parent_word;
  mote_words #(.Seed(Seed), .Stream(Stream)) u_parent_words (
      .clk_i, .rst_ni, .advance_i(issues_q), .word_o(parent_word));
  logic [23:0] uniform_q;
  logic [SlotWidth-1:0] parent_q;
  logic unused_word;
  assign unused_word = ^parent_word[7:0];
  always_ff @(posedge clk_i) begin
    uniform_q <= parent_word[31:8];
    parent_q  <= SlotWidth'((At + 25)'(uniform_q) * (At + 25)'(n_q) >> 24);
  end
  logic valid4, valid_log;
  mote_valid #(.Depth(4)) u_valid4 (.clk_i, .rst_ni, .valid_i(issues_q), .valid_o(valid4));
  logic bank_q;
  logic [StateWidth-1:0] parent_state;
  mote_ram #(.Width(StateWidth), .Words(2 << SlotWidth)) u_set (
      .clk_i,
      .write_i(kept_valid_o),
      .write_at_i({~bank_q, kept_slot_o}),
      .write_word_i(kept_state_o),
      .read_at_i({bank_q, parent_q}),
      .read_word_o(parent_state));

  // ---- the model's arithmetic
  assign propose_valid_o = valid4;
  assign propose_state_o = parent_state;
  for (genvar w = 0; w < DrawWords; w++) begin : gen_words
    mote_words #(.Seed(Seed), .Stream(Stream + 2 + w)) u_words (
        .clk_i, .rst_ni, .advance_i(valid4), .word_o(propose_words_o[w]));
  end
  mote_valid #(.Depth(ProposeLatency)) u_weigh_valid (
      .clk_i, .rst_ni, .valid_i(valid4), .valid_o(weigh_valid_o));
  assign weigh_state_o = propose_state_i;
  logic weighed_valid;
  mote_valid #(.Depth(WeighLatency)) u_weighed_valid (
      .clk_i, .rst_ni, .valid_i(weigh_valid_o), .valid_o(weighed_valid));
  logic [StateWidth-1:0] decided_state, inferred_state;
  mote_delay #(.Width(StateWidth), .Depth(WeighLatency + 1)) u_decided_state (
      .clk_i, .d_i(propose_state_i), .d_o(decided_state));
  mote_delay #(.Width(StateWidth), .Depth(4)) u_inferred_state (
      .clk_i, .d_i(decided_state), .d_o(inferred_state));

  // ---- the chain; its words begin 5 cycles before the log weight is there
  mote_valid #(.Depth(ModelLatency - 1)) u_log_valid (
      .clk_i, .rst_ni, .valid_i(issues_q), .valid_o(valid_log));
  logic [31:0] accept_word;
  logic [15:0] drop;
  mote_words #(.Seed(Seed), .Stream(Stream + 1)) u_accept_words (
      .clk_i, .rst_ni, .advance_i(valid_log), .word_o(accept_word));
  mote_log_uniform #(.Table(Log2Table)) u_log_uniform (.clk_i, .word_i(accept_word), .drop_o(drop));

  typedef logic signed [LogWidth:0] bound_t;
  logic decides_q, accepts, starts, keeps;
  bound_t bound_q;
  logic signed [LogWidth-1:0] log_q, current_log_q;
  logic [StateWidth-1:0] current_q;
  count_t decided_q, accepted_q;
  logic [SlotWidth-1:0] slot_q;
  assign starts = decided_q == '0;
  assign accepts = starts || bound_t'(current_log_q) <= bound_q;
  assign keeps = decided_q >= drop_q;
  assign decided_last = decides_q && decided_q + count_t'(1) == total_q;
  always_ff @(posedge clk_i) begin
    bound_q <= bound_t'(weigh_log_i) + bound_t'({1'b0, drop});
    log_q   <= weigh_log_i;
    if (decides_q && accepts) begin
      current_log_q <= log_q;
      current_q     <= decided_state;
    end
    if (begins) slot_q <= '0;
    else if (kept_valid_o) slot_q <= slot_q + SlotWidth'(1);
  end
  logic kept_q, kept_first_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      decides_q <= 1'b0;
      kept_q    <= 1'b0;
      bank_q    <= 1'b0;
    end else begin
      decides_q <= weighed_valid;
      kept_q    <= decides_q && keeps;
      if (decided_last) bank_q <= ~bank_q;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) decided_q <= '0;
    else if (decides_q) decided_q <= decided_last ? '0 : decided_q + count_t'(1);
  end
  always_ff @(posedge clk_i) begin
    if (decides_q) accepted_q <= starts ? '0 : accepted_q + count_t'(accepts);
    kept_first_q <= decided_q == drop_q;
  end
  assign kept_valid_o = decides_q && keeps;
  assign kept_slot_o = slot_q;
  assign kept_state_o = accepts ? decided_state : current_q;

  // ---- inference
  logic weight_valid, weight_first, weighed_first_q;
  logic [2:0] weight_rise;
  logic [WeightWidth-1:0] weight;
  logic signed [ScaleWidth-1:0] scale, unused_scale;
  count_t weighed_q, summed_q;
  logic summed_last;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      weighed_q <= '0;
      summed_q  <= '0;
    end else begin
      if (weighed_valid) weighed_q <= weighed_q + count_t'(1) == total_q ? '0 : weighed_q + count_t'(1);
      if (weight_valid) summed_q <= summed_last ? '0 : summed_q + count_t'(1);
    end
  end
  assign weighed_first_q = weighed_q == '0;
  assign summed_last = weight_valid && summed_q + count_t'(1) == total_q;
  mote_weight #(.LogWidth(LogWidth), .Width(WeightWidth), .Table(Exp2Table)) u_weight (
      .clk_i, .rst_ni,
      .valid_i(weighed_valid),
      .first_i(weighed_first_q),
      .log_weight_i(weigh_log_i),
      .valid_o(weight_valid),
      .first_o(weight_first),
      .rise_o(weight_rise),
      .weight_o(weight),
      .scale_o(scale),
      .scale_early_o(unused_scale));

  logic [15:0] steps_left_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) steps_left_q <= '0;
    else if (start_i && !busy_o) steps_left_q <= steps_i;
    else if (summed_last) steps_left_q <= steps_left_q - 16'd1;
  end
  logic unused_pending;
  logic [SumWidth-1:0] unused_sum;
  mote_estimate #(
      .Dims(Dims), .ValueWidth(ValueWidth), .Width(WeightWidth), .At(At), .Extra(Extra), .ScaleWidth(ScaleWidth)
  ) u_estimate (
      .clk_i, .rst_ni,
      .weight_valid_i(weight_valid),
      .weight_first_i(weight_first),
      .weight_rise_i(weight_rise),
      .weight_i(weight),
      .scale_i(scale),
      .sum_so_far_o(unused_sum),
      .value_valid_i(equal_q ? kept_q : weight_valid),
      .value_first_i(equal_q ? kept_first_q : weight_first),
      .value_rise_i(equal_q ? 3'd0 : weight_rise),
      .value_weight_i(equal_q ? WeightWidth'(1) << 16 : weight),
      .value_i(equal_q ? current_q : inferred_state),
      .done_i(summed_last),
      .last_i(steps_left_q == 16'd1),
      .equal_i(equal_q),
      .count_i(n_q),
      .accepted_i(accepted_q),
      .pending_o(unused_pending),
      .valid_o(est_valid_o),
      .ready_i(est_ready_i),
      .last_o(est_last_o),
      .mean_o(est_mean_o),
      .sum_o(est_sum_o),
      .scale_o(est_scale_o),
      .accepted_o(est_accepted_o));
endmodule
