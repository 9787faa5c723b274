// The bootstrap filter, merged and overlapped, by one lane or several: propagate, weigh and sum in one pass; the resampling
// of a step walks beside the propagation of the next.
//
//   x' ~ p(. | x_a(j)),  lw = log2 p(y | x'),  a(j) by resampling, every step
//   mean = sum w x' / sum w, before resampling
//
// Lane l has the children Lanes k + l (a Scheme of mote_resample).
// The arithmetic of a model is outside, as for chains. t_o and obs_o stand from 3 cycles before the first state of a
// step reaches propose until its last leaves weigh. At t = 1 the parent's state is undefined.
//
// formats  states: Dims signed words of ValueWidth bits; log weights: signed, octaves, 10 fraction bits
// range    Lanes 1, 2, 4 or 8; n_i a multiple of it, from Lanes to 2^At; At >= 6. Registers are read at start_i
// timing   a particle every Interval cycles and lane, from the step's first chance on, as long as there are parents; a step's first are there 13 + 3 Product cycles (with several
//          lanes 14 + 3 Product + 3 log2 Lanes) after its last state left weigh, or when its first row with children is
//          reached. The golden model counts cycles exactly
// golden   mote/hardware/filters/sisr.hpp
// source   FPGA (merged loops, dataflow); Kitagawa 1996
module mote_sisr #(
    parameter int unsigned Lanes          = 1,
    parameter int unsigned Scheme         = 0,
    parameter int unsigned Interval       = 1,
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
    parameter int unsigned Product        = 1,
    parameter Exp2Table                   = "exp2.hex",
    parameter bit TableLogic              = 1'b0,
    localparam int unsigned ScaleWidth = LogWidth - 12,
    localparam int unsigned SumWidth   = WeightWidth + At,
    localparam int unsigned MeanWidth  = ValueWidth + Extra + 1,
    localparam int unsigned StateWidth = Dims * ValueWidth,
    localparam int unsigned SlotWidth  = At - $clog2(Lanes)
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
    output logic [Lanes*StateWidth-1:0]           propose_state_o,
    output logic [Lanes*DrawWords*32-1:0]         propose_words_o,
    input  logic [Lanes*StateWidth-1:0]           propose_state_i,
    output logic                                   weigh_valid_o,
    output logic [Lanes*StateWidth-1:0]           weigh_state_o,
    input  logic [Lanes*LogWidth-1:0]             weigh_log_i,
    // the set before resampling, as it is written: slots of each lane
    output logic                                   kept_valid_o,
    output logic        [SlotWidth-1:0]            kept_slot_o,
    output logic [Lanes*StateWidth-1:0]           kept_state_o,
    // estimates, AXI4-Stream
    output logic                                   est_valid_o,
    input  logic                                   est_ready_i,
    output logic                                   est_last_o,
    output logic        [Dims*MeanWidth-1:0]       est_mean_o,
    output logic        [SumWidth-1:0]             est_sum_o,
    output logic signed [ScaleWidth-1:0]           est_scale_o
);
  typedef logic [At:0] count_t;

  localparam int unsigned LaneBits = $clog2(Lanes);
  localparam int unsigned WeightLatency = 3 + LaneBits;

  // ---- steps: each begins when the model has weighed the one before; of a lane
  localparam int unsigned LaneWidth = Lanes > 1 ? LaneBits : 1;
  count_t n_q, issue_left_q, weigh_left_q;
  logic starts, begins, begun_q, issues_q, turn, issues, issues_last, first_q, parent_valid, unused_none_left;
  logic weighed_valid, weighed_last, weighed_first_q;
  logic [Lanes*At-1:0] parent;
  mote_steps #(.ObsWidth(ObsWidth)) u_steps (
      .clk_i, .rst_ni, .start_i, .steps_i, .busy_o, .starts_o(starts),
      .obs_valid_i, .obs_ready_o, .obs_i,
      .free_i(weighed_last), .begins_o(begins), .none_left_o(unused_none_left), .t_o, .obs_o,
      .est_taken_i(est_valid_o && est_ready_i), .est_last_i(est_last_o));
  mote_turn #(.Interval(Interval)) u_turn (.clk_i, .first_i(begun_q), .asks_i(issues_q), .turn_o(turn));
  assign issues = turn && (first_q || parent_valid);
  assign issues_last = issues && issue_left_q == (At + 1)'(1);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      begun_q  <= 1'b0;
      issues_q <= 1'b0;
      first_q  <= 1'b0;
    end else begin
      begun_q  <= begins;
      issues_q <= begun_q || issues_q && !issues_last;
      if (begins) first_q <= t_o == '0;
    end
  end
  always_ff @(posedge clk_i) begin
    if (starts) n_q <= n_i >> LaneBits;
    if (begun_q) issue_left_q <= n_q;
    else if (issues) issue_left_q <= issue_left_q - (At + 1)'(1);
  end

  // ---- particles
  logic [SlotWidth-1:0] slot_q;
  logic bank_q;
  logic [Lanes*(SlotWidth+1)-1:0] parent_slot;
  logic [Lanes*LaneWidth-1:0] parent_lane;
  always_comb begin
    for (int l = 0; l < Lanes; l++) begin
      parent_slot[l*(SlotWidth+1)+:SlotWidth+1] = {~bank_q, parent[(l+1)*At-1-:SlotWidth]};
      parent_lane[l*LaneWidth+:LaneWidth] = Lanes > 1 ? parent[l*At+:LaneWidth] : '0;
    end
  end
  mote_set #(.Lanes(Lanes), .Width(StateWidth), .SlotWidth(SlotWidth + 1)) u_set (
      .clk_i,
      .write_i(kept_valid_o),
      .write_slot_i({bank_q, slot_q}),
      .write_state_i(kept_state_o),
      .read_slot_i(parent_slot),
      .read_lane_i(parent_lane),
      .read_state_o(propose_state_o));

  // ---- the model's arithmetic
  mote_valid #(.Depth(2)) u_propose_valid (.clk_i, .rst_ni, .valid_i(issues), .valid_o(propose_valid_o));
  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    for (genvar w = 0; w < DrawWords; w++) begin : gen_words
      mote_words #(.Seed(Seed), .Stream(Stream + 1 + DrawWords * l + w)) u_words (
          .clk_i, .rst_ni, .advance_i(propose_valid_o), .word_o(propose_words_o[(l*DrawWords+w)*32+:32]));
    end
  end
  mote_valid #(.Depth(ProposeLatency)) u_weigh_valid (
      .clk_i, .rst_ni, .valid_i(propose_valid_o), .valid_o(weigh_valid_o));
  assign weigh_state_o = propose_state_i;
  mote_valid #(.Depth(WeighLatency)) u_weighed_valid (
      .clk_i, .rst_ni, .valid_i(weigh_valid_o), .valid_o(weighed_valid));
  mote_delay #(.Width(Lanes * StateWidth), .Depth(WeighLatency + WeightLatency)) u_state (
      .clk_i, .d_i(propose_state_i), .d_o(kept_state_o));
  assign weighed_last = weighed_valid && weigh_left_q == (At + 1)'(1);
  always_ff @(posedge clk_i) begin
    if (begins) weigh_left_q <= n_q;
    else if (weighed_valid) weigh_left_q <= weigh_left_q - (At + 1)'(1);
    if (begins) weighed_first_q <= 1'b1;
    else if (weighed_valid) weighed_first_q <= 1'b0;
  end

  // ---- weights
  logic kept_last;
  logic [1:0] weight_rise;
  logic [Lanes*WeightWidth-1:0] weight;
  logic [Lanes*18-1:0] weight_short;
  logic signed [ScaleWidth-1:0] scale;
  mote_weight #(.Lanes(Lanes), .LogWidth(LogWidth), .Width(WeightWidth), .Table(Exp2Table), .TableLogic(TableLogic)) u_weight (
      .clk_i, .rst_ni,
      .valid_i(weighed_valid),
      .first_i(weighed_first_q),
      .log_weight_i(weigh_log_i),
      .valid_o(kept_valid_o),
      .rise_o(weight_rise),
      .weight_o(weight),
      .short_o(weight_short),
      .scale_o(scale));
  assign kept_slot_o = slot_q;
  mote_valid #(.Depth(WeightLatency)) u_kept_last (.clk_i, .rst_ni, .valid_i(weighed_last), .valid_o(kept_last));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      slot_q <= '0;
      bank_q <= 1'b0;
    end else if (kept_valid_o) begin
      slot_q <= kept_last ? '0 : slot_q + SlotWidth'(1);
      bank_q <= bank_q ^ kept_last;
    end
  end

  // ---- resampling
  logic [15:0] estimates_left_q;
  logic [SumWidth-1:0] total;
  mote_resample #(
      .Lanes(Lanes), .Scheme(Scheme), .At(At), .Width(WeightWidth), .ScaleWidth(ScaleWidth), .Seed(Seed), .Stream(Stream),
      .Product(Product)
  ) u_resample (
      .clk_i, .rst_ni,
      .starts_i(starts),
      .n_i(n_q),
      .write_i(kept_valid_o),
      .last_i(kept_last),
      .rise_i(weight_rise),
      .weight_i(weight),
      .short_i(weight_short),
      .scale_i(scale),
      .total_i(total),
      .more_i(estimates_left_q != '0),
      .valid_o(parent_valid),
      .ready_i(turn && !first_q),
      .parent_o(parent));

  // ---- estimates
  logic unused_pending;
  logic [At:0] unused_accepted;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) estimates_left_q <= '0;
    else if (starts) estimates_left_q <= steps_i;
    else if (kept_last) estimates_left_q <= estimates_left_q - 16'd1;
  end
  mote_estimate #(
      .Lanes(Lanes), .Dims(Dims), .ValueWidth(ValueWidth), .Width(WeightWidth), .At(At), .Extra(Extra), .ScaleWidth(ScaleWidth),
      .Product(Product)
  ) u_estimate (
      .clk_i, .rst_ni,
      .weight_valid_i(kept_valid_o),
      .weight_rise_i(weight_rise),
      .weight_i(weight),
      .scale_i(scale),
      .sum_so_far_o(total),
      .value_valid_i(kept_valid_o),
      .value_rise_i(weight_rise),
      .value_weight_i(weight),
      .value_i(kept_state_o),
      .done_i(kept_last),
      .last_i(estimates_left_q == 16'd1),
      .equal_i(1'b0),
      .count_i(n_q << LaneBits),
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
