// The filter without resampling: independent Metropolis-Hastings over proposals from the mixture of parents, by one chain
// or by Lanes copies of it in lockstep.
//
//   for j = 0 .. Q/Lanes + N_b - 1, in every lane:   i ~ U{parents},  x' ~ p(. | x_i),  lw' = log2 p(y | x')
//   accept x' after x   iff   j = 0  or  lw <= lw' - log2 u
//   keeps the last N/Lanes states of each chain; mean over all proposals by weight, or over the kept (chain_mean_i)
//
// Parents says whose states a lane's parents are: 0 its own chain's, 1 all chains', in a common turn (banked), 2 all
// chains', each by itself (shared: a copy of the set for every lane); see mote_parents.
// The arithmetic of a model is outside, pipelines without stalls, one a lane: propose (state_i, words -> state,
// ProposeLatency cycles) and weigh (state -> log weight, WeighLatency cycles). t_o and obs_o stand from 4 cycles before
// the first state of a step reaches propose until its last leaves weigh. At t = 1 the parent's state is undefined: propose
// draws it from the prior.
//
// formats  states: Dims signed words of ValueWidth bits; log weights: signed, octaves, 10 fraction bits
// range    Lanes a power of two, n_i and draws_i multiples of it; Lanes <= n_i <= Most; n_i <= draws_i;
//          draws_i + Lanes burn_in_i <= 2^At; Most <= 2^At. Registers are read at start_i
// timing   a step takes (N_b + Q/Lanes - 1) + K_p + K_w + 1 cycles, exactly (IMH-HW 5.3 with T_p = T_w = T_D = 1):
//          K_p = 4 + ProposeLatency, K_w = WeighLatency + 1; the estimate follows 7 + Dims (ValueWidth + Extra + 1)
//          cycles (1 + log2 Lanes more with several lanes) behind the last decision. It waits for an observation, and for the
//          estimate of the step before the last to be taken. ProposeLatency + WeighLatency >= 6
// golden   mote/hardware/filters/imh.hpp
// source   IMH-HW figs. 2 and 3, (16) - (17)
module mote_imh #(
    parameter int unsigned Lanes          = 1,
    parameter int unsigned Parents        = 1,
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
    localparam int unsigned SlotWidth  = Most > Lanes ? $clog2(Most / Lanes) : 1
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
    output logic [Lanes*StateWidth-1:0]           propose_state_o,
    output logic [Lanes*DrawWords*32-1:0]         propose_words_o,
    input  logic [Lanes*StateWidth-1:0]           propose_state_i,
    output logic                                   weigh_valid_o,
    output logic [Lanes*StateWidth-1:0]           weigh_state_o,
    input  logic [Lanes*LogWidth-1:0]             weigh_log_i,
    // the set, as it is written: slots of each lane
    output logic                                   kept_valid_o,
    output logic        [SlotWidth-1:0]            kept_slot_o,
    output logic [Lanes*StateWidth-1:0]           kept_state_o,
    // estimates, AXI4-Stream
    output logic                                   est_valid_o,
    input  logic                                   est_ready_i,
    output logic                                   est_last_o,
    output logic        [Dims*MeanWidth-1:0]       est_mean_o,
    output logic        [SumWidth-1:0]             est_sum_o,
    output logic signed [ScaleWidth-1:0]           est_scale_o,
    output logic        [At:0]                     est_accepted_o
);
  localparam int unsigned ModelLatency = ProposeLatency + WeighLatency;
  typedef logic [At:0] count_t;

  // ---- what a run is, of a lane
  localparam int unsigned LaneBits = $clog2(Lanes);
  localparam int unsigned Streams = 2 + DrawWords;  // of a lane: parents, acceptance, draws
  count_t n_q, total_q, drop_q, per_lane_n, per_lane_draws;
  assign per_lane_n = n_i >> LaneBits;
  assign per_lane_draws = draws_i >> LaneBits;
  logic equal_q;
  logic starts_run;
  always_ff @(posedge clk_i) begin
    if (starts_run) begin
      n_q     <= per_lane_n;
      total_q <= per_lane_draws + burn_in_i;
      drop_q  <= per_lane_draws + burn_in_i - per_lane_n;
      equal_q <= chain_mean_i;
    end
  end

  // ---- steps: each begins when the one before has decided all
  logic begins, issues_q, decided_last, unused_none_left;
  count_t issue_q;
  mote_steps #(.ObsWidth(ObsWidth)) u_steps (
      .clk_i, .rst_ni, .start_i, .steps_i, .busy_o, .starts_o(starts_run),
      .obs_valid_i, .obs_ready_o, .obs_i,
      .free_i(decided_last), .begins_o(begins), .none_left_o(unused_none_left), .t_o, .obs_o,
      .est_taken_i(est_valid_o && est_ready_i), .est_last_i(est_last_o));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) issues_q <= 1'b0;
    else if (begins) issues_q <= 1'b1;
    else if (issue_q + (At + 1)'(1) == total_q) issues_q <= 1'b0;
  end
  always_ff @(posedge clk_i) begin
    if (begins) issue_q <= '0;
    else if (issues_q) issue_q <= issue_q + (At + 1)'(1);
  end

  // ---- parents
  logic valid4, valid_log, bank_q;
  mote_valid #(.Depth(4)) u_valid4 (.clk_i, .rst_ni, .valid_i(issues_q), .valid_o(valid4));
  mote_parents #(
      .Lanes(Lanes), .Choice(Parents), .Width(StateWidth), .CountWidth(At + 1), .SlotWidth(SlotWidth), .Seed(Seed),
      .Stream(Stream), .StreamStep(Streams)
  ) u_parents (
      .clk_i, .rst_ni,
      .advance_i(issues_q),
      .n_i(n_q),
      .bank_i(bank_q),
      .state_o(propose_state_o),
      .write_i(kept_valid_o),
      .write_slot_i(kept_slot_o),
      .write_state_i(kept_state_o));

  // ---- the model's arithmetic, and the chains, whose words begin 5 cycles before the log weight is there
  logic weighed_valid, decides_q, starts, keeps;
  logic [Lanes-1:0] accepts;
  logic [Lanes*StateWidth-1:0] decided_state, current;
  assign propose_valid_o = valid4;
  assign weigh_state_o = propose_state_i;
  mote_valid #(.Depth(ProposeLatency)) u_weigh_valid (
      .clk_i, .rst_ni, .valid_i(valid4), .valid_o(weigh_valid_o));
  mote_valid #(.Depth(WeighLatency)) u_weighed_valid (
      .clk_i, .rst_ni, .valid_i(weigh_valid_o), .valid_o(weighed_valid));
  mote_valid #(.Depth(ModelLatency - 1)) u_log_valid (
      .clk_i, .rst_ni, .valid_i(issues_q), .valid_o(valid_log));
  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    for (genvar w = 0; w < DrawWords; w++) begin : gen_words
      mote_words #(.Seed(Seed), .Stream(Stream + Streams * l + 2 + w)) u_words (
          .clk_i, .rst_ni, .advance_i(valid4), .word_o(propose_words_o[(l*DrawWords+w)*32+:32]));
    end
    mote_delay #(.Width(StateWidth), .Depth(WeighLatency + 1)) u_decided_state (
        .clk_i, .d_i(propose_state_i[l*StateWidth+:StateWidth]), .d_o(decided_state[l*StateWidth+:StateWidth]));
    mote_chain #(
        .LogWidth(LogWidth), .StateWidth(StateWidth), .Seed(Seed), .Stream(Stream + Streams * l + 1),
        .Log2Table(Log2Table)
    ) u_chain (
        .clk_i, .rst_ni,
        .word_i(valid_log),
        .log_weight_i(weigh_log_i[l*LogWidth+:LogWidth]),
        .decides_i(decides_q),
        .starts_i(starts),
        .state_i(decided_state[l*StateWidth+:StateWidth]),
        .accepts_o(accepts[l]),
        .state_o(kept_state_o[l*StateWidth+:StateWidth]),
        .current_o(current[l*StateWidth+:StateWidth]));
  end

  count_t decided_q, accepted_q, moves;
  always_comb begin
    moves = '0;
    for (int l = 0; l < Lanes; l++) moves = moves + (At + 1)'(accepts[l]);
  end
  logic [SlotWidth-1:0] slot_q;
  logic kept_q, kept_first_q;
  assign starts = decided_q == '0;
  assign keeps = decided_q >= drop_q;
  assign decided_last = decides_q && decided_q + (At + 1)'(1) == total_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      decides_q <= 1'b0;
      kept_q    <= 1'b0;
      bank_q    <= 1'b0;
      decided_q <= '0;
    end else begin
      decides_q <= weighed_valid;
      kept_q    <= kept_valid_o;
      if (decided_last) bank_q <= ~bank_q;
      if (decides_q) decided_q <= decided_last ? '0 : decided_q + (At + 1)'(1);
    end
  end
  always_ff @(posedge clk_i) begin
    if (begins) slot_q <= '0;
    else if (kept_valid_o) slot_q <= slot_q + SlotWidth'(1);
    if (decides_q) accepted_q <= starts ? '0 : accepted_q + moves;
    kept_first_q <= decided_q == drop_q;
  end
  assign kept_valid_o = decides_q && keeps;
  assign kept_slot_o = slot_q;

  // ---- inference
  logic weight_valid, weighed_first;
  logic [1:0] weight_rise;
  logic [Lanes*WeightWidth-1:0] weight;
  logic [Lanes*StateWidth-1:0] inferred_state;
  mote_delay #(.Width(Lanes * StateWidth), .Depth(Lanes > 1 ? 3 : 2)) u_inferred_state (
      .clk_i, .d_i(decided_state), .d_o(inferred_state));
  logic signed [ScaleWidth-1:0] scale;
  count_t weighed_q, summed_q;
  logic summed_last;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      weighed_q <= '0;
      summed_q  <= '0;
    end else begin
      if (weighed_valid) weighed_q <= weighed_q + (At + 1)'(1) == total_q ? '0 : weighed_q + (At + 1)'(1);
      if (weight_valid) summed_q <= summed_last ? '0 : summed_q + (At + 1)'(1);
    end
  end
  assign weighed_first = weighed_q == '0;
  assign summed_last = weight_valid && summed_q + (At + 1)'(1) == total_q;
  mote_weight #(.Lanes(Lanes), .LogWidth(LogWidth), .Width(WeightWidth), .Table(Exp2Table)) u_weight (
      .clk_i, .rst_ni,
      .valid_i(weighed_valid),
      .first_i(weighed_first),
      .log_weight_i(weigh_log_i),
      .valid_o(weight_valid),
      .rise_o(weight_rise),
      .weight_o(weight),
      .scale_o(scale));

  logic [15:0] steps_left_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) steps_left_q <= '0;
    else if (starts_run) steps_left_q <= steps_i;
    else if (summed_last) steps_left_q <= steps_left_q - 16'd1;
  end
  logic unused_pending;
  logic [SumWidth-1:0] unused_sum;
  mote_estimate #(
      .Lanes(Lanes), .Dims(Dims), .ValueWidth(ValueWidth), .Width(WeightWidth), .At(At), .Extra(Extra), .ScaleWidth(ScaleWidth)
  ) u_estimate (
      .clk_i, .rst_ni,
      .weight_valid_i(weight_valid),
      .weight_rise_i(weight_rise),
      .weight_i(weight),
      .scale_i(scale),
      .sum_so_far_o(unused_sum),
      .value_valid_i(equal_q ? kept_q : weight_valid),
      .value_rise_i(equal_q ? {2{kept_first_q}} : weight_rise),
      .value_weight_i(equal_q ? {Lanes{WeightWidth'(1) << 16}} : weight),
      .value_i(equal_q ? current : inferred_state),
      .done_i(summed_last),
      .last_i(steps_left_q == 16'd1),
      .equal_i(equal_q),
      .count_i(n_q << LaneBits),
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
