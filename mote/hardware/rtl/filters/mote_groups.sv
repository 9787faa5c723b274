// The parallel particle filter: a group of particles in each lane, which resamples by itself, hands some of its children on
// to the next group of a ring, and gives its part of the estimate by its weight.
//
//   x' ~ p(. | x_a(j)),  lw = log2 p(y | x'),  a(j) by a Scheme of mote_resample inside the group, every step
//   M of a group's children, evenly spread over them, have the parents that the group before it has drawn for its own
//   mean = sum w x' / sum w over all groups, before resampling: group means by group weights
//
// A group's weights have a scale of their own, so that it resamples well however little it counts; they are lowered to the
// scale of all groups for the estimate. After resampling all particles count the same, as in a single filter.
//
// The arithmetic of a model is outside, as for mote_sisr, and ports are mote_sisr's; t_o and obs_o stand as there.
//
// formats  states: Dims signed words of ValueWidth bits; log weights: signed, octaves, 10 fraction bits
// range    Lanes 1, 2, 4 or 8; n_i a multiple of it, at least Lanes and at most 2^At; 0 <= exchange_i <= n_i / Lanes;
//          2^At / Lanes at least 64. Registers are read at start_i
// timing   a particle a cycle and lane, as long as every group has a parent; else as mote_sisr. The golden model counts
//          cycles exactly
// golden   mote/hardware/filters/groups.hpp
// source   PPF, fig. 3.4 (c); Bolic, Djuric & Hong 2005 (local exchange)
module mote_groups #(
    parameter int unsigned Lanes          = 4,
    parameter int unsigned Scheme         = 0,
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
    input  logic        [At:0]                     exchange_i,
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
  localparam int unsigned LaneBits = $clog2(Lanes);
  localparam int unsigned WeightLatency = 3;
  localparam int unsigned GroupSumWidth = WeightWidth + SlotWidth;
  typedef logic [SlotWidth:0] count_t;  // of a group

  // ---- steps: each begins when the model has weighed the one before
  count_t n_q, issue_left_q, weigh_left_q;
  logic starts, begins, begun_q, issues_q, issues, issues_last, first_q, takes, all_show, unused_none_left, unused_count;
  logic weighed_valid, weighed_last, weighed_first_q;
  logic [Lanes-1:0] parent_valid;
  mote_steps #(.ObsWidth(ObsWidth)) u_steps (
      .clk_i, .rst_ni, .start_i, .steps_i, .busy_o, .starts_o(starts),
      .obs_valid_i, .obs_ready_o, .obs_i,
      .free_i(weighed_last), .begins_o(begins), .none_left_o(unused_none_left), .t_o, .obs_o,
      .est_taken_i(est_valid_o && est_ready_i), .est_last_i(est_last_o));
  assign all_show = &parent_valid;
  assign takes = issues_q && !first_q && all_show;
  assign issues = issues_q && (first_q || all_show);
  assign issues_last = issues && issue_left_q == (SlotWidth + 1)'(1);
  assign unused_count = ^exchange_i;
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
    if (starts) n_q <= (SlotWidth + 1)'(n_i >> LaneBits);
    if (begun_q) issue_left_q <= n_q;
    else if (issues) issue_left_q <= issue_left_q - (SlotWidth + 1)'(1);
  end

  // ---- which children are exchanged: M of n, evenly spread
  count_t exchange_q, behind_q;
  logic [SlotWidth+1:0] ahead;
  logic exchanges, exchanges2;
  assign ahead = (SlotWidth + 2)'(behind_q) + (SlotWidth + 2)'(exchange_q);
  assign exchanges = ahead >= (SlotWidth + 2)'(n_q);
  always_ff @(posedge clk_i) begin
    if (starts) exchange_q <= (SlotWidth + 1)'(exchange_i);
    if (begins) behind_q <= n_q >> 1;
    else if (issues) behind_q <= (SlotWidth + 1)'(ahead) - (exchanges ? n_q : '0);
  end
  mote_delay #(.Width(1), .Depth(2)) u_exchanges (.clk_i, .d_i(exchanges), .d_o(exchanges2));

  // ---- particles: a memory a group, and the ring
  logic [SlotWidth-1:0] slot_q;
  logic bank_q;
  logic [Lanes*SlotWidth-1:0] parent;
  logic [Lanes*StateWidth-1:0] read;
  for (genvar l = 0; l < Lanes; l++) begin : gen_set
    localparam int unsigned Before = (l + Lanes - 1) % Lanes;
    mote_ram #(.Width(StateWidth), .Words(2 << SlotWidth)) u_states (
        .clk_i,
        .write_i(kept_valid_o),
        .write_at_i({bank_q, slot_q}),
        .write_word_i(kept_state_o[l*StateWidth+:StateWidth]),
        .read_at_i({~bank_q, parent[l*SlotWidth+:SlotWidth]}),
        .read_word_o(read[l*StateWidth+:StateWidth]));
    assign propose_state_o[l*StateWidth+:StateWidth] = read[(exchanges2?Before:l)*StateWidth+:StateWidth];
  end

  // ---- the model's arithmetic
  mote_valid #(.Depth(2)) u_propose_valid (.clk_i, .rst_ni, .valid_i(issues), .valid_o(propose_valid_o));
  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    for (genvar w = 0; w < DrawWords; w++) begin : gen_words
      mote_words #(.Seed(Seed), .Stream(Stream + Lanes + DrawWords * l + w)) u_words (
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
  assign weighed_last = weighed_valid && weigh_left_q == (SlotWidth + 1)'(1);
  always_ff @(posedge clk_i) begin
    if (begins) weigh_left_q <= n_q;
    else if (weighed_valid) weigh_left_q <= weigh_left_q - (SlotWidth + 1)'(1);
    if (begins) weighed_first_q <= 1'b1;
    else if (weighed_valid) weighed_first_q <= 1'b0;
  end

  // ---- slots
  logic kept_last;
  logic [Lanes-1:0] valids;
  logic [Lanes*WeightWidth-1:0] weight;
  logic [Lanes*ScaleWidth-1:0] scale;
  logic [15:0] estimates_left_q;
  logic unused_same;
  assign kept_valid_o = valids[0];
  assign unused_same = ^valids;
  assign kept_slot_o = slot_q;
  mote_valid #(.Depth(WeightLatency)) u_kept_last (.clk_i, .rst_ni, .valid_i(weighed_last), .valid_o(kept_last));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      slot_q <= '0;
      bank_q <= 1'b0;
      estimates_left_q <= '0;
    end else begin
      if (kept_valid_o) begin
        slot_q <= kept_last ? '0 : slot_q + SlotWidth'(1);
        bank_q <= bank_q ^ kept_last;
      end
      if (starts) estimates_left_q <= steps_i;
      else if (kept_last) estimates_left_q <= estimates_left_q - 16'd1;
    end
  end

  // ---- groups: weights at each one's scale
  for (genvar l = 0; l < Lanes; l++) begin : gen_group
    logic [1:0] rise;
    logic [17:0] weight_short;
    logic [GroupSumWidth-1:0] total_q;
    mote_weight #(.LogWidth(LogWidth), .Width(WeightWidth), .Table(Exp2Table), .TableLogic(TableLogic)) u_weight (
        .clk_i, .rst_ni,
        .valid_i(weighed_valid),
        .first_i(weighed_first_q),
        .log_weight_i(weigh_log_i[l*LogWidth+:LogWidth]),
        .valid_o(valids[l]),
        .rise_o(rise),
        .weight_o(weight[l*WeightWidth+:WeightWidth]),
        .short_o(weight_short),
        .scale_o(scale[l*ScaleWidth+:ScaleWidth]));
    always_ff @(posedge clk_i) begin
      if (kept_valid_o)
        total_q <= (rise == 2'd3 ? '0 : total_q >> {rise, 3'b0}) + GroupSumWidth'(weight[l*WeightWidth+:WeightWidth]);
    end
    mote_resample #(
        .Scheme(Scheme), .At(SlotWidth), .Width(WeightWidth), .ScaleWidth(ScaleWidth), .Seed(Seed), .Stream(Stream + l),
        .Product(Product)
    ) u_resample (
        .clk_i, .rst_ni,
        .starts_i(starts),
        .n_i(n_q),
        .write_i(kept_valid_o),
        .last_i(kept_last),
        .rise_i(rise),
        .weight_i(weight[l*WeightWidth+:WeightWidth]),
        .short_i(weight_short),
        .scale_i(scale[l*ScaleWidth+:ScaleWidth]),
        .total_i(total_q),
        .more_i(estimates_left_q != '0),
        .valid_o(parent_valid[l]),
        .ready_i(takes),
        .parent_o(parent[l*SlotWidth+:SlotWidth]));
  end

  // ---- weights at the scale of all groups
  logic valid1, valid2, last2, first_row_q;
  logic signed [ScaleWidth-1:0] most1, most2_q;
  logic [ScaleWidth-1:0] risen;
  logic [1:0] rise2_q;
  logic [Lanes*WeightWidth-1:0] weight1, weight2_q;
  logic [Lanes*ScaleWidth-1:0] scale1;
  logic [Lanes*StateWidth-1:0] state2;
  function automatic logic [1:0] limited(input logic [ScaleWidth-1:0] difference);
    limited = difference > ScaleWidth'(3) ? 2'd3 : difference[1:0];
  endfunction
  function automatic logic [WeightWidth-1:0] lowered(input logic [WeightWidth-1:0] from, input logic [1:0] quanta);
    lowered = quanta == 2'd3 ? '0 : from >> {quanta, 3'b0};
  endfunction
  mote_row #(.Lanes(Lanes), .Width(ScaleWidth), .RowWidth(ScaleWidth), .Signed(1'b1), .Greatest(1'b1)) u_most (
      .clk_i, .word_i(scale), .row_o(most1));
  assign risen = most1 - most2_q;
  mote_delay #(.Width(Lanes * (WeightWidth + ScaleWidth)), .Depth(LaneBits)) u_row (
      .clk_i, .d_i({weight, scale}), .d_o({weight1, scale1}));
  mote_valid #(.Depth(LaneBits)) u_valid1 (.clk_i, .rst_ni, .valid_i(kept_valid_o), .valid_o(valid1));
  mote_valid #(.Depth(1)) u_valid2 (.clk_i, .rst_ni, .valid_i(valid1), .valid_o(valid2));
  mote_valid #(.Depth(LaneBits + 1)) u_last2 (.clk_i, .rst_ni, .valid_i(kept_last), .valid_o(last2));
  mote_delay #(.Width(Lanes * StateWidth), .Depth(LaneBits + 1)) u_state2 (.clk_i, .d_i(kept_state_o), .d_o(state2));
  always_ff @(posedge clk_i) begin
    if (starts || last2) first_row_q <= 1'b1;
    else if (valid1) first_row_q <= 1'b0;
    rise2_q   <= first_row_q ? 2'd3 : limited(risen);
    if (valid1) most2_q <= most1;
    for (int l = 0; l < Lanes; l++)
      weight2_q[l*WeightWidth+:WeightWidth] <= lowered(
          weight1[l*WeightWidth+:WeightWidth], limited(most1 - $signed(scale1[l*ScaleWidth+:ScaleWidth])));
  end

  // ---- estimates
  logic unused_pending;
  logic [At:0] unused_accepted;
  logic [SumWidth-1:0] unused_sum;
  logic ends_q;  // the step whose sums end is the run's last
  always_ff @(posedge clk_i) if (kept_last) ends_q <= estimates_left_q == 16'd1;
  mote_estimate #(
      .Lanes(Lanes), .Dims(Dims), .ValueWidth(ValueWidth), .Width(WeightWidth), .At(At), .Extra(Extra), .ScaleWidth(ScaleWidth),
      .Product(Product)
  ) u_estimate (
      .clk_i, .rst_ni,
      .weight_valid_i(valid2),
      .weight_rise_i(rise2_q),
      .weight_i(weight2_q),
      .scale_i(most2_q),
      .sum_so_far_o(unused_sum),
      .value_valid_i(valid2),
      .value_rise_i(rise2_q),
      .value_weight_i(weight2_q),
      .value_i(state2),
      .done_i(last2),
      .last_i(ends_q),
      .equal_i(1'b0),
      .count_i((At + 1)'(n_q) << LaneBits),
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
