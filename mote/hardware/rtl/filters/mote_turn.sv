// The cycles in which rows may go into pipelines that take one every Interval cycles: from the one behind first_i on, every
// Interval-th, whether a row went in or not, so that rows under way together are a multiple of Interval apart.
//
//   turn_o = asks_i in those cycles
//
// timing  a choice in the same cycle; Interval = 1 is a wire
module mote_turn #(
    parameter int unsigned Interval = 1
) (
    input  logic clk_i,
    input  logic first_i,
    input  logic asks_i,
    output logic turn_o
);
  if (Interval == 1) begin : gen_always
    logic unused_first;
    assign unused_first = clk_i ^ first_i;
    assign turn_o = asks_i;
  end else begin : gen_turns
    logic [Interval-1:0] turn_q;  // one bit goes round
    always_ff @(posedge clk_i) turn_q <= first_i ? Interval'(1) : {turn_q[Interval-2:0], turn_q[Interval-1]};
    assign turn_o = asks_i && turn_q[0];
  end
endmodule
