// The IMH filter of growth_propose.sv, for co-simulation.
module imh_growth #(
    parameter int unsigned Lanes   = 1,
    parameter int unsigned Parents = 1,
    parameter int unsigned Folded  = 0,
    parameter int unsigned Overlapped = 0,
    parameter int unsigned Interval = 1,
    localparam int unsigned SlotWidth = $clog2(1024 / Lanes)
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               start_i,
    input  logic        [12:0] n_i,
    input  logic        [12:0] draws_i,
    input  logic        [12:0] burn_in_i,
    input  logic        [15:0] steps_i,
    input  logic               chain_mean_i,
    output logic               busy_o,
    input  logic               obs_valid_i,
    output logic               obs_ready_o,
    input  logic        [57:0] obs_i,
    output logic               kept_valid_o,
    output logic        [SlotWidth-1:0] kept_slot_o,
    output logic        [Lanes-1:0][35:0] kept_state_o,
    output logic               est_valid_o,
    input  logic               est_ready_i,
    output logic               est_last_o,
    output logic        [53:0] est_mean_o,
    output logic        [35:0] est_sum_o,
    output logic signed [11:0] est_scale_o,
    output logic        [12:0] est_accepted_o
);
  logic [15:0] t;
  logic [57:0] observed, weigh_observed;
  logic [Lanes-1:0][1:0][17:0] parent, proposed, to_weigh;
  logic [Lanes-1:0][1:0][31:0] words;
  logic [Lanes-1:0][23:0] log_weight;
  logic unused_propose_valid, unused_weigh_valid;
  mote_imh #(
      .Lanes(Lanes), .Parents(Parents), .Folded(Folded), .Overlapped(Overlapped), .Interval(Interval), .Dims(2), .ObsWidth(58), .DrawWords(2),
      .ProposeLatency(6), .WeighLatency(5)
  ) u_imh (
      .clk_i, .rst_ni, .start_i, .n_i, .draws_i, .burn_in_i, .steps_i, .chain_mean_i, .busy_o,
      .obs_valid_i, .obs_ready_o, .obs_i,
      .t_o(t), .obs_o(observed),
      .propose_valid_o(unused_propose_valid), .propose_state_o(parent), .propose_words_o(words),
      .propose_state_i(proposed),
      .weigh_obs_o(weigh_observed), .weigh_valid_o(unused_weigh_valid), .weigh_state_o(to_weigh), .weigh_log_i(log_weight),
      .kept_valid_o, .kept_slot_o, .kept_state_o,
      .est_valid_o, .est_ready_i, .est_last_o, .est_mean_o, .est_sum_o, .est_scale_o, .est_accepted_o);
  // The pipelines read these so many cycles behind a state: where steps overlap they are to go with it.
  logic first;
  logic [17:0] cosine;
  logic [39:0] seen;
  mote_delay #(.Depth(Overlapped == 1 ? 1 : 0)) u_first (.clk_i, .d_i(t == 16'd1), .d_o(first));
  mote_delay #(.Width(18), .Depth(Overlapped == 1 ? 2 : 0)) u_cosine (.clk_i, .d_i(observed[57:40]), .d_o(cosine));
  mote_delay #(.Width(40), .Depth(Overlapped == 1 ? 2 : 0)) u_seen (.clk_i, .d_i(weigh_observed[39:0]), .d_o(seen));
  logic unused_observed;
  assign unused_observed = ^{observed[39:0], weigh_observed[57:40]};
  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    for (genvar d = 0; d < 2; d++) begin : gen_propose
      growth_propose u_propose (
          .clk_i, .first_i(first), .cosine_i($signed(cosine)), .state_i($signed(parent[l][d])),
          .word_i(words[l][d]), .state_o(proposed[l][d]));
    end
    growth_weigh u_weigh (
        .clk_i, .observed_i(seen), .state_i(to_weigh[l]), .log_weight_o(log_weight[l]));
  end
endmodule
