// The bootstrap filter on particles that have their number in the step and their parent's for a state: those below the
// observation weigh alike, the others nothing. So a run chooses which rows of particles have children.
//
//   x' = (j, first word of x_a(j)),   lw = 0 where j < y, else -1024
//
// timing  latencies 1 and 1
// golden  ranked() in models.hpp
module sisr_ranked (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               start_i,
    input  logic        [10:0] n_i,
    input  logic        [15:0] steps_i,
    output logic               busy_o,
    input  logic               obs_valid_i,
    output logic               obs_ready_o,
    input  logic        [11:0] obs_i,
    output logic               kept_valid_o,
    output logic        [9:0]  kept_slot_o,
    output logic        [23:0] kept_state_o,
    output logic               est_valid_o,
    input  logic               est_ready_i,
    output logic               est_last_o,
    output logic        [41:0] est_mean_o,
    output logic        [33:0] est_sum_o,
    output logic signed [11:0] est_scale_o
);
  logic [15:0] t, t_q;
  logic [11:0] observed, rank_q;
  logic [23:0] parent, proposed_q, to_weigh, log_weight_q;
  logic propose_valid, unused_weigh_valid, unused;
  logic [31:0] unused_words;
  assign unused = ^{parent[23:12], to_weigh[23:12]};
  mote_sisr #(.Dims(2), .ValueWidth(12), .ObsWidth(12), .ProposeLatency(1), .WeighLatency(1)) u_sisr (
      .clk_i, .rst_ni, .start_i, .n_i, .steps_i, .busy_o,
      .obs_valid_i, .obs_ready_o, .obs_i,
      .t_o(t), .obs_o(observed),
      .propose_valid_o(propose_valid), .propose_state_o(parent), .propose_words_o(unused_words),
      .propose_state_i(proposed_q),
      .weigh_valid_o(unused_weigh_valid), .weigh_state_o(to_weigh), .weigh_log_i(log_weight_q),
      .kept_valid_o, .kept_slot_o, .kept_state_o,
      .est_valid_o, .est_ready_i, .est_last_o, .est_mean_o, .est_sum_o, .est_scale_o);
  always_ff @(posedge clk_i) begin
    t_q <= t;
    if (t != t_q) rank_q <= '0;
    else if (propose_valid) rank_q <= rank_q + 12'd1;
    proposed_q   <= {t == 16'd1 ? 12'd0 : parent[11:0], rank_q};
    log_weight_q <= to_weigh[11:0] < observed ? '0 : -24'sd1048576;
  end
endmodule
