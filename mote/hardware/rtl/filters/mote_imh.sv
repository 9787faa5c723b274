// The filter without resampling: independent Metropolis-Hastings over proposals from the mixture of parents, by one chain,
// by Lanes copies of it in lockstep, or by one chain that Lanes pairs of pipelines feed (Folded).
//
//   for j = 0 .. Q/Lanes + N_b - 1, in every lane:   i ~ U{parents},  x' ~ p(. | x_i),  lw' = log2 p(y | x')
//   accept x' after x   iff   j = 0  or  lw <= lw' - log2 u
//   keeps the last N/Lanes states of each chain; mean over all proposals by weight, or over the kept (chain_mean_i)
//
// Folded: the chain visits the proposals of a row lane by lane (mote_fold), so that N_b is of one chain: Q/Lanes + N_b/Lanes
// rows, the latter rounded up; slot k of the set holds the states k Lanes .. k Lanes + Lanes - 1 that were kept. Of one lane that
// is what it would be without.
// Parents says whose states a lane's parents are: 0 its own chain's, 1 all chains', in a common turn (banked), 2 all
// chains', each by itself (shared: a copy of the set for every lane); see mote_parents.
// Overlapped: a step begins to propose while the one before is still decided on. Its first proposals have their parents among
// the states that have emerged by then, n = N/Lanes slots in all:
//   slots of row j:  min(n, n - H + j),   H = min(W, floor(n / 2)),   W = K_p + K_w - 1
// The arithmetic of a model is outside, pipelines without stalls, one a lane: propose (state_i, words -> state,
// ProposeLatency cycles) and weigh (state -> log weight, WeighLatency cycles). t_o and obs_o stand from 3 + Product cycles before
// the first state of a step reaches propose until its last leaves weigh. Overlapped, they and weigh_obs_o change with a step's
// first state at propose and at weigh, whose pipelines delay them with each particle. At t = 1 the parent's state is undefined:
// propose draws it from the prior.
//
// With CarryWidth a proposal is a state and, above it, what only weigh takes: the parent, of which the auxiliary-variable
// filter's weights (IMH-OPT 23) are made.
//
// formats  states: Dims signed words of ValueWidth bits; log weights: signed, octaves, 10 fraction bits
// range    Lanes a power of two, n_i and draws_i multiples of it; Lanes <= n_i <= Most; n_i <= draws_i;
//          draws_i + Lanes burn_in_i <= 2^At (Folded: draws_i + burn_in_i); Most <= 2^At. Registers are read at start_i
// timing   a row every Interval = T cycles; a step of r rows takes (r - 1) T + K_p + K_w + 1 cycles, exactly (IMH-HW 5.3 with
//          T_p = T_w = T, T_D = 1; of pairs with T_D = 1/Lanes): K_p = 3 + Product + ProposeLatency (several lanes
//          whose Parents are not 2: one more), K_w = WeighLatency + 1 (Folded, Lanes > 1: WeighLatency + Lanes + 2); the estimate
//          follows 6 + Product + Dims (ValueWidth + Extra + 1) cycles (2 log2 Lanes more with several lanes) behind the last decision, of
//          a folded chain sooner or later, see imh.cpp. A step waits for an observation, and for the estimate of the
//          step before the last to be taken. Overlapped: r + W - H cycles; r where n >= 2 W.
//          ProposeLatency + WeighLatency >= 6; Interval = 1 where steps overlap
// golden   mote/hardware/filters/imh.hpp
// source   IMH-HW figs. 2 and 3, (16) - (17); IMH-OPT fig. 2
module mote_imh #(
    parameter int unsigned Lanes          = 1,
    parameter int unsigned Parents        = 1,
    parameter int unsigned Folded         = 0,
    parameter int unsigned Overlapped     = 0,
    parameter int unsigned Interval       = 1,
    parameter int unsigned Dims           = 1,
    parameter int unsigned ValueWidth     = 18,
    parameter int unsigned CarryWidth     = 0,
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
    parameter int unsigned Product        = 1,
    parameter Exp2Table                   = "exp2.hex",
    parameter bit TableLogic              = 1'b0,
    parameter Log2Table                   = "log2.hex",
    localparam int unsigned ScaleWidth = LogWidth - 12,
    localparam int unsigned SumWidth   = WeightWidth + At,
    localparam int unsigned MeanWidth  = ValueWidth + Extra + 1,
    localparam int unsigned StateWidth = Dims * ValueWidth,
    localparam int unsigned PairWidth  = StateWidth + CarryWidth,
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
    input  logic [Lanes*PairWidth-1:0]            propose_state_i,
    output logic        [ObsWidth-1:0]             weigh_obs_o,
    output logic                                   weigh_valid_o,
    output logic [Lanes*PairWidth-1:0]            weigh_state_o,
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
  localparam bit Pairs = Folded == 1 && Lanes > 1;
  localparam int unsigned ChainLatency = Pairs ? Lanes + 2 : 1;  // from the log weights of a row to what is decided
  localparam int unsigned SlotLatency = 1 + Product + (Lanes > 1 && Parents != 2 ? 1 : 0);  // until a parent's slot is read
  localparam int unsigned ParentLatency = SlotLatency + 2;  // of mote_parents
  localparam int unsigned Window = ParentLatency + ModelLatency + ChainLatency - 1;  // a state emerges a cycle after it is decided on
  typedef logic [At:0] count_t;

  // ---- what a run is, of a lane
  localparam int unsigned LaneBits = $clog2(Lanes);
  localparam int unsigned Streams = 2 + DrawWords;  // of a lane: parents, acceptance, draws
  count_t n_q, last_row_q, drop_q, per_lane_n, rows;
  assign per_lane_n = n_i >> LaneBits;
  assign rows = (draws_i >> LaneBits) + (Pairs ? (burn_in_i + (At + 1)'(Lanes - 1)) >> LaneBits : burn_in_i);
  logic equal_q;
  logic starts_run;
  always_ff @(posedge clk_i) begin
    if (starts_run) begin
      n_q        <= per_lane_n;
      last_row_q <= rows - (At + 1)'(1);
      drop_q     <= rows - per_lane_n;
      equal_q    <= chain_mean_i;
    end
  end

  // ---- steps: each begins when the one before has decided all, or enough
  logic begins, issuing_q, issues, issue_last, decided_last, free, unused_none_left;
  logic [15:0] step;
  logic [ObsWidth-1:0] observed;
  count_t issue_q, slots;
  assign issue_last = issues && issue_q == last_row_q;
  mote_steps #(.ObsWidth(ObsWidth)) u_steps (
      .clk_i, .rst_ni, .start_i, .steps_i, .busy_o, .starts_o(starts_run),
      .obs_valid_i, .obs_ready_o, .obs_i,
      .free_i(free), .begins_o(begins), .none_left_o(unused_none_left), .t_o(step), .obs_o(observed),
      .est_taken_i(est_valid_o && est_ready_i), .est_last_i(est_last_o));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) issuing_q <= 1'b0;
    else if (begins) issuing_q <= 1'b1;
    else if (issue_last) issuing_q <= 1'b0;
  end
  always_ff @(posedge clk_i) begin
    if (begins) issue_q <= '0;
    else if (issues) issue_q <= issue_q + (At + 1)'(1);
  end
  mote_turn #(.Interval(Interval)) u_turn (.clk_i, .first_i(begins), .asks_i(issuing_q), .turn_o(issues));
  logic bank_q, read_bank;  // bank_q: what the last whole step left
  logic [Lanes*StateWidth-1:0] current;
  if (Overlapped == 1) begin : gen_overlapped
    localparam int unsigned GapWidth = $clog2(Window + 1);
    localparam int unsigned HeadWidth = GapWidth > At ? GapWidth + 1 : At + 1;  // the window may be longer than any step
    logic [HeadWidth-1:0] half, head;
    count_t window_q, slots_q, first_q;
    logic [GapWidth-1:0] gap_q, left_q;
    logic reads_next, proposes_next, weighs_next, read_bank_q;
    assign half = HeadWidth'(per_lane_n[At:1]);
    assign head = half > HeadWidth'(Window) ? HeadWidth'(Window) : half;
    assign free = issue_last && gap_q == '0 || left_q == GapWidth'(1);
    mote_valid #(.Depth(SlotLatency)) u_reads (.clk_i, .rst_ni, .valid_i(begins), .valid_o(reads_next));
    mote_valid #(.Depth(2)) u_proposes (.clk_i, .rst_ni, .valid_i(reads_next), .valid_o(proposes_next));
    mote_valid #(.Depth(ProposeLatency)) u_weighs (.clk_i, .rst_ni, .valid_i(proposes_next), .valid_o(weighs_next));
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        left_q      <= '0;
        read_bank_q <= 1'b1;
      end else begin
        if (issue_last) left_q <= gap_q;
        else if (left_q != '0) left_q <= left_q - GapWidth'(1);
        if (reads_next) read_bank_q <= ~read_bank_q;
      end
    end
    always_ff @(posedge clk_i) begin
      if (starts_run) begin
        first_q <= per_lane_n - (At + 1)'(head);
        gap_q   <= GapWidth'(HeadWidth'(Window) - head);
      end
      if (begins) window_q <= first_q;
      else if (issues && window_q != n_q) window_q <= window_q + (At + 1)'(1);
      slots_q <= window_q;
      if (proposes_next) begin
        t_o   <= step;
        obs_o <= observed;
      end
      if (weighs_next) weigh_obs_o <= obs_o;
    end
    assign slots = slots_q;
    assign read_bank = read_bank_q;
  end else begin : gen_apart
    assign free = decided_last;
    assign slots = n_q;
    assign read_bank = bank_q;
    assign t_o = step;
    assign obs_o = observed;
    assign weigh_obs_o = observed;
  end

  // ---- parents
  logic parent_valid, valid_log;
  mote_valid #(.Depth(ParentLatency)) u_parent_valid (.clk_i, .rst_ni, .valid_i(issues), .valid_o(parent_valid));
  mote_parents #(
      .Lanes(Lanes), .Choice(Parents), .Width(StateWidth), .CountWidth(At + 1), .SlotWidth(SlotWidth), .Seed(Seed),
      .Stream(Stream), .StreamStep(Streams), .Product(Product)
  ) u_parents (
      .clk_i, .rst_ni,
      .advance_i(issues),
      .n_i(slots),
      .bank_i(read_bank),
      .state_o(propose_state_o),
      .write_i(kept_valid_o),
      .write_bank_i(~bank_q),
      .write_slot_i(kept_slot_o),
      .write_state_i(current));

  // ---- the model's arithmetic, and the chains, whose words begin 5 cycles before the log weight is there
  localparam int unsigned Scaled = 3 + LaneBits;  // from log weights to weights, the latency of mote_weight
  localparam int unsigned Tap = ChainLatency < Scaled ? ChainLatency : Scaled;
  logic weighed_valid, weighed_first, decides, starts, keeps;
  logic [Lanes-1:0] accepts;
  logic [Lanes*StateWidth-1:0] proposed_state, tapped_state, decided_state;
  assign propose_valid_o = parent_valid;
  assign weigh_state_o = propose_state_i;
  mote_valid #(.Depth(ProposeLatency)) u_weigh_valid (
      .clk_i, .rst_ni, .valid_i(parent_valid), .valid_o(weigh_valid_o));
  mote_valid #(.Depth(WeighLatency)) u_weighed_valid (
      .clk_i, .rst_ni, .valid_i(weigh_valid_o), .valid_o(weighed_valid));
  mote_valid #(.Depth(ParentLatency + ModelLatency - 5)) u_log_valid (
      .clk_i, .rst_ni, .valid_i(issues), .valid_o(valid_log));
  mote_valid #(.Depth(ChainLatency)) u_decides (
      .clk_i, .rst_ni, .valid_i(weighed_valid), .valid_o(decides));
  mote_delay #(.Width(Lanes * StateWidth), .Depth(WeighLatency + Tap)) u_tapped_state (
      .clk_i, .d_i(proposed_state), .d_o(tapped_state));
  mote_delay #(.Width(Lanes * StateWidth), .Depth(ChainLatency - Tap)) u_decided_state (
      .clk_i, .d_i(tapped_state), .d_o(decided_state));
  for (genvar l = 0; l < Lanes; l++) begin : gen_words
    assign proposed_state[l*StateWidth+:StateWidth] = propose_state_i[l*PairWidth+:StateWidth];
    for (genvar w = 0; w < DrawWords; w++) begin : gen_word
      mote_words #(.Seed(Seed), .Stream(Stream + Streams * l + 2 + w)) u_words (
          .clk_i, .rst_ni, .advance_i(parent_valid), .word_o(propose_words_o[(l*DrawWords+w)*32+:32]));
    end
  end
  if (Pairs) begin : gen_folded
    logic [Lanes*StateWidth-1:0] folded;
    mote_fold #(
        .Lanes(Lanes), .LogWidth(LogWidth), .StateWidth(StateWidth), .Seed(Seed), .Stream(Stream + 1),
        .StreamStep(Streams), .Log2Table(Log2Table)
    ) u_fold (
        .clk_i, .rst_ni,
        .word_i(valid_log),
        .valid_i(weighed_valid),
        .first_i(weighed_first),
        .log_weight_i(weigh_log_i),
        .state_i(decided_state),
        .accepts_o(accepts),
        .state_o(folded));
    mote_delay #(.Width(Lanes * StateWidth)) u_current (.clk_i, .d_i(folded), .d_o(current));
  end else begin : gen_chains
    for (genvar l = 0; l < Lanes; l++) begin : gen_lane
      mote_chain #(
          .LogWidth(LogWidth), .StateWidth(StateWidth), .Seed(Seed), .Stream(Stream + Streams * l + 1),
          .Log2Table(Log2Table)
      ) u_chain (
          .clk_i, .rst_ni,
          .word_i(valid_log),
          .log_weight_i(weigh_log_i[l*LogWidth+:LogWidth]),
          .first_i(weighed_first),
          .decides_i(decides),
          .state_i(decided_state[l*StateWidth+:StateWidth]),
          .accepts_o(accepts[l]),
          .current_o(current[l*StateWidth+:StateWidth]));
    end
  end

  // What a row moved the chains by, counted a cycle later; that they start is no move.
  count_t decided_q, accepted_q, accepted_d, accepted, moves;
  logic [Lanes-1:0] accepts_q;
  logic counts_q, started_q;
  always_comb begin
    moves = '0;
    for (int l = 0; l < Lanes; l++) moves = moves + (At + 1)'(accepts_q[l]);
  end
  assign accepted_d = !started_q ? accepted_q + moves : Pairs ? moves : '0;
  logic [SlotWidth-1:0] slot_q;
  logic kept_q, kept_first_q, last_q;
  assign starts = decided_q == '0;
  assign keeps = decided_q >= drop_q;
  assign decided_last = decides && decided_q == last_row_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      kept_q    <= 1'b0;
      last_q    <= 1'b0;
      bank_q    <= 1'b0;
      decided_q <= '0;
      slot_q    <= '0;
    end else begin
      kept_q <= decides && keeps;
      last_q <= decided_last;
      if (last_q) bank_q <= ~bank_q;
      if (decides) decided_q <= decided_last ? '0 : decided_q + (At + 1)'(1);
      if (kept_q) slot_q <= last_q ? '0 : slot_q + SlotWidth'(1);
    end
  end
  always_ff @(posedge clk_i) begin
    {accepts_q, counts_q, started_q} <= {accepts, decides, starts};
    if (counts_q) accepted_q <= accepted_d;
    kept_first_q <= decided_q == drop_q;
  end
  if (Overlapped == 1) begin : gen_accepted  // the next step's first decision comes at once
    count_t accepted_last_q;
    logic ended_q;
    always_ff @(posedge clk_i) begin
      ended_q <= decided_last;
      if (ended_q) accepted_last_q <= accepted_d;
    end
    assign accepted = accepted_last_q;
  end else begin : gen_accepted
    assign accepted = accepted_q;
  end
  // The set is written a cycle after the decision: comparison, choice and memory are no path.
  assign kept_valid_o = kept_q;
  assign kept_slot_o = slot_q;
  assign kept_state_o = current;

  // ---- inference: weights are there Scaled cycles after their logarithms, kept states ChainLatency + 1; all is in at Done,
  // and where the next step's follow at once both come by then
  localparam int unsigned Done = ChainLatency + 1 > Scaled ? ChainLatency + 1 : Scaled;
  localparam int unsigned HoldWeights = Overlapped == 1 ? Done - Scaled : 0;
  localparam int unsigned HoldKept = Overlapped == 1 ? Done - (ChainLatency + 1) : 0;
  localparam logic [WeightWidth-1:0] Unit = WeightWidth'(65536);
  localparam int unsigned WeightBits = 2 + ScaleWidth + Lanes * WeightWidth;
  logic scaled_valid, weight_valid;
  logic [1:0] scaled_rise, weight_rise;
  logic [Lanes*WeightWidth-1:0] scaled, weight;
  logic [Lanes*18-1:0] unused_short;
  logic [Lanes*StateWidth-1:0] inferred_state, kept;
  logic signed [ScaleWidth-1:0] scaled_scale, scale;
  logic kept_valid, kept_first;
  mote_weight #(.Lanes(Lanes), .LogWidth(LogWidth), .Width(WeightWidth), .Table(Exp2Table), .TableLogic(TableLogic)) u_weight (
      .clk_i, .rst_ni,
      .valid_i(weighed_valid),
      .first_i(weighed_first),
      .log_weight_i(weigh_log_i),
      .valid_o(scaled_valid),
      .rise_o(scaled_rise),
      .weight_o(scaled),
      .short_o(unused_short),
      .scale_o(scaled_scale));
  mote_valid #(.Depth(HoldWeights)) u_weight_valid (
      .clk_i, .rst_ni, .valid_i(scaled_valid), .valid_o(weight_valid));
  mote_delay #(.Width(WeightBits), .Depth(HoldWeights)) u_held_weight (
      .clk_i, .d_i({scaled_rise, scaled_scale, scaled}), .d_o({weight_rise, scale, weight}));
  mote_delay #(.Width(Lanes * StateWidth), .Depth(Scaled + HoldWeights - Tap)) u_inferred_state (
      .clk_i, .d_i(tapped_state), .d_o(inferred_state));
  mote_valid #(.Depth(HoldKept)) u_kept_valid (.clk_i, .rst_ni, .valid_i(kept_q), .valid_o(kept_valid));
  mote_delay #(.Width(1 + Lanes * StateWidth), .Depth(HoldKept)) u_kept (
      .clk_i, .d_i({kept_first_q, current}), .d_o({kept_first, kept}));

  count_t weighed_q, summed_q;
  logic summed_last, done, last;
  logic [15:0] steps_left_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      weighed_q    <= '0;
      summed_q     <= '0;
      steps_left_q <= '0;
    end else begin
      if (weighed_valid) weighed_q <= weighed_q == last_row_q ? '0 : weighed_q + (At + 1)'(1);
      if (weight_valid) summed_q <= summed_last ? '0 : summed_q + (At + 1)'(1);
      if (starts_run) steps_left_q <= steps_i;
      else if (summed_last) steps_left_q <= steps_left_q - 16'd1;
    end
  end
  assign weighed_first = weighed_q == '0;
  assign summed_last = weight_valid && summed_q == last_row_q;
  mote_valid #(.Depth(Done - Scaled - HoldWeights)) u_done (.clk_i, .rst_ni, .valid_i(summed_last), .valid_o(done));
  mote_delay #(.Width(1), .Depth(Done - Scaled - HoldWeights)) u_last (
      .clk_i, .d_i(steps_left_q == 16'd1), .d_o(last));
  logic unused_pending;
  logic [SumWidth-1:0] unused_sum;
  mote_estimate #(
      .Lanes(Lanes), .Dims(Dims), .ValueWidth(ValueWidth), .Width(WeightWidth), .At(At), .Extra(Extra), .ScaleWidth(ScaleWidth),
      .Overlapped(Overlapped), .Product(Product)
  ) u_estimate (
      .clk_i, .rst_ni,
      .weight_valid_i(weight_valid),
      .weight_rise_i(weight_rise),
      .weight_i(weight),
      .scale_i(scale),
      .sum_so_far_o(unused_sum),
      .value_valid_i(equal_q ? kept_valid : weight_valid),
      .value_rise_i(equal_q ? {2{kept_first}} : weight_rise),
      .value_weight_i(equal_q ? {Lanes{Unit}} : weight),
      .value_i(equal_q ? kept : inferred_state),
      .done_i(done),
      .last_i(last),
      .equal_i(equal_q),
      .count_i(n_q << LaneBits),
      .accepted_i(accepted),
      .pending_o(unused_pending),
      .valid_o(est_valid_o),
      .ready_i(est_ready_i),
      .last_o(est_last_o),
      .mean_o(est_mean_o),
      .sum_o(est_sum_o),
      .scale_o(est_scale_o),
      .accepted_o(est_accepted_o));
endmodule
