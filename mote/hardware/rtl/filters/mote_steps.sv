// The steps of a run: registers a start, takes an observation ahead, and lets a step begin when the filter is free and the
// estimate of the step before the last has left.
//
// timing  begins_o: with an observation at hand, in the cycle of free_i or any later one; t_o and obs_o from the next cycle on.
//         free_i tells that the step so far is through, for a cycle; stream of observations as AXI4-Stream
// golden  mote/hardware/filters/pace.hpp
module mote_steps #(
    parameter int unsigned ObsWidth = 32
) (
    input  logic                clk_i,
    input  logic                rst_ni,
    // registers
    input  logic                start_i,
    input  logic [15:0]         steps_i,
    output logic                busy_o,
    output logic                starts_o,
    // observations
    input  logic                obs_valid_i,
    output logic                obs_ready_o,
    input  logic [ObsWidth-1:0] obs_i,
    // the filter
    input  logic                free_i,
    output logic                begins_o,
    output logic                none_left_o,
    output logic [15:0]         t_o,
    output logic [ObsWidth-1:0] obs_o,
    // estimates that leave
    input  logic                est_taken_i,
    input  logic                est_last_i
);
  logic next_valid_q, idle_q;
  logic [ObsWidth-1:0] next_obs_q;
  logic [15:0] left_q;
  logic [1:0] out_q;
  assign starts_o = start_i && !busy_o;
  assign none_left_o = left_q == '0;
  assign begins_o = (idle_q || free_i) && !none_left_o && next_valid_q && !out_q[1];
  assign obs_ready_o = !next_valid_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_o       <= 1'b0;
      left_q       <= '0;
      next_valid_q <= 1'b0;
      idle_q       <= 1'b1;
      out_q        <= '0;
      t_o          <= '0;
    end else begin
      if (starts_o) begin
        busy_o <= steps_i != '0;
        left_q <= steps_i;
        t_o    <= '0;
      end else begin
        if (est_taken_i && est_last_i) busy_o <= 1'b0;
        if (begins_o) begin
          left_q <= left_q - 16'd1;
          t_o    <= t_o + 16'd1;
        end
      end
      if (obs_valid_i && obs_ready_o) next_valid_q <= 1'b1;
      else if (begins_o) next_valid_q <= 1'b0;
      if (begins_o) idle_q <= 1'b0;
      else if (free_i) idle_q <= 1'b1;
      out_q <= out_q + 2'(begins_o) - 2'(est_taken_i);
    end
  end
  always_ff @(posedge clk_i) begin
    if (obs_valid_i && obs_ready_o) next_obs_q <= obs_i;
    if (begins_o) obs_o <= next_obs_q;
  end
endmodule
