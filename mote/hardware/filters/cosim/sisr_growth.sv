// The bootstrap filter of growth_propose.sv, for co-simulation.
module sisr_growth #(
    parameter int unsigned Lanes = 1,
    parameter int unsigned Interval = 1,
    localparam int unsigned SlotWidth = 10 - $clog2(Lanes)
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               start_i,
    input  logic        [10:0] n_i,
    input  logic        [15:0] steps_i,
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
    output logic        [33:0] est_sum_o,
    output logic signed [11:0] est_scale_o
);
  logic [15:0] t;
  logic [57:0] observed;
  logic [Lanes-1:0][1:0][17:0] parent, proposed, to_weigh;
  logic [Lanes-1:0][1:0][31:0] words;
  logic [Lanes-1:0][23:0] log_weight;
  logic unused_propose_valid, unused_weigh_valid;
  mote_sisr #(
      .Lanes(Lanes), .Interval(Interval), .Dims(2), .ObsWidth(58), .DrawWords(2), .ProposeLatency(6), .WeighLatency(5)
  ) u_sisr (
      .clk_i, .rst_ni, .start_i, .n_i, .steps_i, .busy_o,
      .obs_valid_i, .obs_ready_o, .obs_i,
      .t_o(t), .obs_o(observed),
      .propose_valid_o(unused_propose_valid), .propose_state_o(parent), .propose_words_o(words),
      .propose_state_i(proposed),
      .weigh_valid_o(unused_weigh_valid), .weigh_state_o(to_weigh), .weigh_log_i(log_weight),
      .kept_valid_o, .kept_slot_o, .kept_state_o,
      .est_valid_o, .est_ready_i, .est_last_o, .est_mean_o, .est_sum_o, .est_scale_o);
  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    for (genvar d = 0; d < 2; d++) begin : gen_propose
      growth_propose u_propose (
          .clk_i, .first_i(t == 16'd1), .cosine_i($signed(observed[57:40])), .state_i($signed(parent[l][d])),
          .word_i(words[l][d]), .state_o(proposed[l][d]));
    end
    growth_weigh u_weigh (
        .clk_i, .observed_i(observed[39:0]), .state_i(to_weigh[l]), .log_weight_o(log_weight[l]));
  end
endmodule
