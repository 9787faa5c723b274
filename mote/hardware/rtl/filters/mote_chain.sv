// A chain of independent Metropolis-Hastings: decides on a proposal a cycle.
//
//   accepts_o  =  first_i  or  lw <= lw' - log2 u      lw of the chain's state, lw' of the proposal, u uniform
//   current_o(n + 1)  =  state_i where it accepts, else the chain's state
//
// formats  log weights: signed, octaves, 10 fraction bits
// timing   word_i, then log_weight_i and first_i 5 cycles later, decides_i and state_i a cycle after that; accepts_o in
//          the same cycle, current_o in the next. Initiation interval 1. The first proposal's bound is the
//          greatest there is, so that the comparison alone decides
// golden   mote/hardware/filters/imh.hpp
// source   IMH-HW (16) - (17)
module mote_chain #(
    parameter int unsigned LogWidth   = 24,
    parameter int unsigned StateWidth = 18,
    parameter logic [63:0] Seed       = 64'd1,
    parameter int unsigned Stream     = 1,
    parameter Log2Table               = "log2.hex"
) (
    input  logic                       clk_i,
    input  logic                       rst_ni,
    input  logic                       word_i,
    input  logic signed [LogWidth-1:0] log_weight_i,
    input  logic                       first_i,
    input  logic                       decides_i,
    input  logic [StateWidth-1:0]      state_i,
    output logic                       accepts_o,
    output logic [StateWidth-1:0]      current_o
);
  logic [31:0] word;
  logic [15:0] drop;
  mote_words #(.Seed(Seed), .Stream(Stream)) u_words (.clk_i, .rst_ni, .advance_i(word_i), .word_o(word));
  mote_log_uniform #(.Table(Log2Table)) u_log_uniform (.clk_i, .word_i(word), .drop_o(drop));

  // lw <= b is the carry of b - lw, whose sides stand in registers as the sum takes them: with their sign bits turned over, lw as
  // its complement.
  logic signed [LogWidth:0] bound;
  logic [LogWidth:0] bound_q, unused_difference;
  logic [LogWidth-1:0] not_log_q, not_current_q;
  logic unused_carry;
  assign bound = (LogWidth + 1)'(log_weight_i) + (LogWidth + 1)'({1'b0, drop});
  assign {accepts_o, unused_difference, unused_carry} =
      {1'b0, bound_q, 1'b1} + {1'b0, ~not_current_q[LogWidth-1], not_current_q, 1'b1};
  always_ff @(posedge clk_i) begin
    bound_q   <= first_i ? '1 : {~bound[LogWidth], bound[LogWidth-1:0]};
    not_log_q <= ~log_weight_i;
    if (decides_i && accepts_o) current_o <= state_i;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin  // a number from the first comparison on
    if (!rst_ni) not_current_q <= '0;
    else if (decides_i && accepts_o) not_current_q <= not_log_q;
  end
endmodule
