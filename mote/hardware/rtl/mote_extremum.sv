// mote_extremum: the lesser or the greater of two numbers of one format.
//
// equation  y = max(a, b) with Greater, else min(a, b)
// timing    latency 2 (comparison, choice), one number a clock
// twin      Extremum in mote/hardware/choice.hpp
module mote_extremum #(
    parameter bit Signed  = 1'b1,
    parameter int Width   = 18,
    parameter bit Greater = 1'b0
) (
    input  logic             clk_i,
    input  logic [Width-1:0] a_i,
    input  logic [Width-1:0] b_i,
    output logic [Width-1:0] y_o
);

  logic [Width-1:0] a_q, b_q;
  logic less_q;

  always_ff @(posedge clk_i) begin
    a_q <= a_i;
    b_q <= b_i;
    less_q <= $signed({Signed && a_i[Width-1], a_i}) < $signed({Signed && b_i[Width-1], b_i});
    y_o <= less_q == Greater ? b_q : a_q;
  end

endmodule
