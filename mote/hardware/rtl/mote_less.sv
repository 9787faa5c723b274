// mote_less: is a number less than another?
//
// equation  y = a < b
// formats   a, b: signed or not, Width bits, Fraction of them after the point; compared without rounding
// timing    latency 1, one answer a clock
// twin      Less in mote/hardware/choice.hpp
module mote_less #(
    parameter bit ASigned = 1'b1,
    parameter int AWidth = 18,
    parameter int AFraction = 10,
    parameter bit BSigned = 1'b1,
    parameter int BWidth = 18,
    parameter int BFraction = 10
) (
    input  logic              clk_i,
    input  logic [AWidth-1:0] a_i,
    input  logic [BWidth-1:0] b_i,
    output logic              y_o
);

  localparam int Fraction = AFraction > BFraction ? AFraction : BFraction;
  localparam int AGrow = Fraction - AFraction;
  localparam int BGrow = Fraction - BFraction;
  localparam int Wide = (AWidth + AGrow > BWidth + BGrow ? AWidth + AGrow : BWidth + BGrow) + 1;

  logic signed [AWidth:0] a;
  logic signed [BWidth:0] b;
  assign a = {ASigned && a_i[AWidth-1], a_i};
  assign b = {BSigned && b_i[BWidth-1], b_i};
  always_ff @(posedge clk_i) y_o <= (Wide'(a) <<< AGrow) < (Wide'(b) <<< BGrow);

endmodule
