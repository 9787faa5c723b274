// The bootstrap filter as loops one after the other, what the merged and overlapped mote_sisr is measured against; the same
// estimates and sets, bit for bit.
//
//   propagate  x'_j ~ p(. | x_a(j))       weigh    lw_j = log2 p(y | x'_j)
//   normalise  w_j = 2^lw_j, sums         resample a(j) by a Scheme of mote_resample
//
// Pipelined 0: a loop's next turn begins when the one before is through; 1: turns follow each other cycle by cycle.
// Merged 1: the first three loops are one. Ports, formats and words are mote_sisr's.
//
// range    1 <= n_i <= 2^At, At >= 6. Registers are read at start_i
// timing   turns of ProposeLatency + 5, WeighLatency + 3, 8 and 8 cycles (merged: ProposeLatency + WeighLatency + 8, 8), or
//          of one cycle and the rest once a loop; the golden model counts cycles exactly
// golden   mote/hardware/filters/sisr.hpp (PlainLoops)
// source   FPGA, table 3: before optimisation, pipelined, merged
module mote_sisr_plain #(
    parameter int unsigned Pipelined      = 0,
    parameter int unsigned Merged         = 0,
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
    output logic        [DrawWords*32-1:0]         propose_words_o,
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
    output logic        [Dims*MeanWidth-1:0]       est_mean_o,
    output logic        [SumWidth-1:0]             est_sum_o,
    output logic signed [ScaleWidth-1:0]           est_scale_o
);
  localparam int unsigned ProposeTurn = Merged != 0 ? ProposeLatency + WeighLatency + 8 : ProposeLatency + 5;
  localparam int unsigned WeighTurn = WeighLatency + 3;
  localparam int unsigned OtherTurn = 6;
  typedef logic [At:0] count_t;

  // ---- steps
  logic starts, begins, none_left, through_q;
  count_t n_q;
  mote_steps #(.ObsWidth(ObsWidth)) u_steps (
      .clk_i, .rst_ni, .start_i, .steps_i, .busy_o, .starts_o(starts),
      .obs_valid_i, .obs_ready_o, .obs_i,
      .free_i(through_q), .begins_o(begins), .none_left_o(none_left), .t_o, .obs_o,
      .est_taken_i(est_valid_o && est_ready_i), .est_last_i(est_last_o));
  always_ff @(posedge clk_i) if (starts) n_q <= n_i;

  // ---- propagate: parents and their states are read, new states written
  logic bank_q, issues, proposed, state_last, weight_last, resampled, unused_turn;
  logic [At-1:0] turn, resample_turn;
  logic [At-1:0] parent_read, parent;
  logic [At:0] read_at;
  logic [StateWidth-1:0] read_state;
  logic resample_valid;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) bank_q <= 1'b0;
    else if (begins) bank_q <= ~bank_q;
  end
  mote_loop #(.At(At), .Interval(Pipelined != 0 ? 1 : ProposeTurn)) u_propagate (
      .clk_i, .rst_ni, .begin_i(begins), .n_i(n_q), .ready_i(1'b1), .valid_o(issues), .last_o(unused_turn), .index_o(turn));
  mote_ram #(.Width(At), .Words(1 << At)) u_parents (
      .clk_i,
      .write_i(resample_valid),
      .write_at_i(resample_turn),
      .write_word_i(parent),
      .read_at_i(turn),
      .read_word_o(parent_read));
  mote_ram #(.Width(StateWidth), .Words(2 << At)) u_set (
      .clk_i,
      .write_i(kept_valid_o),
      .write_at_i({bank_q, kept_slot_o}),
      .write_word_i(kept_state_o),
      .read_at_i(read_at),
      .read_word_o(read_state));
  mote_valid #(.Depth(4)) u_propose_valid (.clk_i, .rst_ni, .valid_i(issues), .valid_o(propose_valid_o));
  assign propose_state_o = read_state;
  for (genvar w = 0; w < DrawWords; w++) begin : gen_words
    mote_words #(.Seed(Seed), .Stream(Stream + 1 + w)) u_words (
        .clk_i, .rst_ni, .advance_i(propose_valid_o), .word_o(propose_words_o[w*32+:32]));
  end
  mote_valid #(.Depth(ProposeLatency)) u_proposed (.clk_i, .rst_ni, .valid_i(propose_valid_o), .valid_o(proposed));
  assign kept_valid_o = proposed;
  assign kept_state_o = propose_state_i;
  assign state_last = proposed && (At + 1)'(kept_slot_o) + (At + 1)'(1) == n_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) kept_slot_o <= '0;
    else if (proposed) kept_slot_o <= state_last ? '0 : kept_slot_o + At'(1);
  end

  // ---- weigh, by a loop of its own or as states come
  logic logged, log_valid;
  logic signed [LogWidth-1:0] log_weight;
  logic [StateWidth-1:0] logged_state, summed_state;
  mote_valid #(.Depth(WeighLatency)) u_logged (.clk_i, .rst_ni, .valid_i(weigh_valid_o), .valid_o(logged));
  if (Merged != 0) begin : gen_merged
    assign read_at = {~bank_q, parent_read};
    assign weigh_valid_o = proposed;
    assign weigh_state_o = propose_state_i;
    assign log_valid = logged;
    assign log_weight = weigh_log_i;
    mote_delay #(.Width(StateWidth), .Depth(WeighLatency)) u_state (
        .clk_i, .d_i(propose_state_i), .d_o(logged_state));
  end else begin : gen_loops
    logic weighs, normalises, log_last, propagates_q;
    logic unused_weigh, unused_normalise;
    logic [At-1:0] weigh_turn, normalise_turn;
    count_t log_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) propagates_q <= 1'b0;
      else propagates_q <= begins || propagates_q && !state_last;
    end
    mote_loop #(.At(At), .Interval(Pipelined != 0 ? 1 : WeighTurn)) u_weigh (
        .clk_i, .rst_ni, .begin_i(state_last), .n_i(n_q), .ready_i(1'b1), .valid_o(weighs), .last_o(unused_weigh),
        .index_o(weigh_turn));
    mote_valid #(.Depth(2)) u_weigh_valid (.clk_i, .rst_ni, .valid_i(weighs), .valid_o(weigh_valid_o));
    assign weigh_state_o = read_state;
    assign log_last = logged && log_q + (At + 1)'(1) == n_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) log_q <= '0;
      else if (logged) log_q <= log_last ? '0 : log_q + (At + 1)'(1);
    end
    mote_ram #(.Width(LogWidth), .Words(1 << At)) u_logs (
        .clk_i,
        .write_i(logged),
        .write_at_i(log_q[At-1:0]),
        .write_word_i(weigh_log_i),
        .read_at_i(normalise_turn),
        .read_word_o(log_weight));
    mote_loop #(.At(At), .Interval(Pipelined != 0 ? 1 : OtherTurn)) u_normalise (
        .clk_i, .rst_ni, .begin_i(log_last), .n_i(n_q), .ready_i(1'b1), .valid_o(normalises), .last_o(unused_normalise),
        .index_o(normalise_turn));
    mote_valid #(.Depth(2)) u_log_valid (.clk_i, .rst_ni, .valid_i(normalises), .valid_o(log_valid));
    assign logged_state = read_state;
    assign read_at = propagates_q ? {~bank_q, parent_read}
                                  : {bank_q, normalises ? normalise_turn : weigh_turn};
  end

  // ---- normalise: weights and their sums
  logic weight_valid, log_first, weighed_last;
  logic [1:0] weight_rise;
  logic [WeightWidth-1:0] weight;
  logic [17:0] weight_short;
  logic signed [ScaleWidth-1:0] scale;
  logic [SumWidth-1:0] total;
  count_t weighed_q, summed_q;
  assign log_first = weighed_q == '0;
  assign weighed_last = log_valid && weighed_q + (At + 1)'(1) == n_q;
  assign weight_last = weight_valid && summed_q + (At + 1)'(1) == n_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {weighed_q, summed_q} <= '0;
    else begin
      if (log_valid) weighed_q <= weighed_last ? '0 : weighed_q + (At + 1)'(1);
      if (weight_valid) summed_q <= weight_last ? '0 : summed_q + (At + 1)'(1);
    end
  end
  mote_weight #(.LogWidth(LogWidth), .Width(WeightWidth), .Table(Exp2Table), .TableLogic(TableLogic)) u_weight (
      .clk_i, .rst_ni,
      .valid_i(log_valid),
      .first_i(log_first),
      .log_weight_i(log_weight),
      .valid_o(weight_valid),
      .rise_o(weight_rise),
      .weight_o(weight),
      .short_o(weight_short),
      .scale_o(scale));
  mote_delay #(.Width(StateWidth), .Depth(3)) u_summed_state (.clk_i, .d_i(logged_state), .d_o(summed_state));

  // ---- resample
  logic [15:0] estimates_left_q;
  logic parent_valid;
  mote_resample #(
      .Scheme(Scheme), .At(At), .Width(WeightWidth), .ScaleWidth(ScaleWidth), .Seed(Seed), .Stream(Stream),
      .Product(Product)
  ) u_parent (
      .clk_i, .rst_ni,
      .starts_i(starts),
      .n_i(n_q),
      .write_i(weight_valid),
      .last_i(weight_last),
      .rise_i(weight_rise),
      .weight_i(weight),
      .short_i(weight_short),
      .scale_i(scale),
      .total_i(total),
      .more_i(estimates_left_q != '0),
      .valid_o(parent_valid),
      .ready_i(resample_valid),
      .parent_o(parent));
  mote_loop #(.At(At), .Interval(Pipelined != 0 ? 1 : OtherTurn)) u_resample (
      .clk_i, .rst_ni, .begin_i(weight_last && !none_left), .n_i(n_q), .ready_i(parent_valid),
      .valid_o(resample_valid), .last_o(resampled), .index_o(resample_turn));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) through_q <= 1'b0;
    else through_q <= resampled || weight_last && none_left;
  end

  // ---- estimates
  logic unused_pending;
  logic [At:0] unused_accepted;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) estimates_left_q <= '0;
    else if (starts) estimates_left_q <= steps_i;
    else if (weight_last) estimates_left_q <= estimates_left_q - 16'd1;
  end
  mote_estimate #(
      .Dims(Dims), .ValueWidth(ValueWidth), .Width(WeightWidth), .At(At), .Extra(Extra), .ScaleWidth(ScaleWidth),
      .Product(Product)
  ) u_estimate (
      .clk_i, .rst_ni,
      .weight_valid_i(weight_valid),
      .weight_rise_i(weight_rise),
      .weight_i(weight),
      .scale_i(scale),
      .sum_so_far_o(total),
      .value_valid_i(weight_valid),
      .value_rise_i(weight_rise),
      .value_weight_i(weight),
      .value_i(summed_state),
      .done_i(weight_last),
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
