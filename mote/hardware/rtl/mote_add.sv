// mote_add: sum or difference of two numbers in any formats, in a third.
//
// equation  y = a + b, or a - b with Subtract
// formats   a, b, y: signed or not, Width bits, Fraction of them after the point (below 0: units above 1)
// range     the sum is exact before it is rounded; mote_resize says how y is rounded, saturates or wraps
// timing    latency 1; 2 where y is rounded to nearest with bits to drop, or saturates, and the exact sum has more than 22
//           bits. One sum a clock
// twin      Sum in mote/hardware/arithmetic.hpp
module mote_add #(
    parameter bit ASigned = 1'b1,
    parameter int AWidth = 18,
    parameter int AFraction = 10,
    parameter bit BSigned = 1'b1,
    parameter int BWidth = 18,
    parameter int BFraction = 10,
    parameter bit YSigned = 1'b1,
    parameter int YWidth = 18,
    parameter int YFraction = 10,
    parameter bit Subtract = 1'b0,
    parameter bit Nearest = 1'b1,
    parameter bit Saturate = 1'b1
) (
    input  logic              clk_i,
    input  logic [AWidth-1:0] a_i,
    input  logic [BWidth-1:0] b_i,
    output logic [YWidth-1:0] y_o
);

  localparam int Fraction = AFraction > BFraction ? AFraction : BFraction;
  localparam int AGrow = Fraction - AFraction;
  localparam int BGrow = Fraction - BFraction;
  localparam int Sum = (AWidth + AGrow > BWidth + BGrow ? AWidth + AGrow : BWidth + BGrow) + 2;
  localparam int OneStage = 22;
  localparam bit Refine = Sum > OneStage && (Saturate || (Nearest && Fraction > YFraction));

  logic signed [AWidth:0] a;
  logic signed [BWidth:0] b;
  logic signed [Sum-1:0] a_grown, b_grown, sum;
  assign a = {ASigned && a_i[AWidth-1], a_i};
  assign b = {BSigned && b_i[BWidth-1], b_i};
  assign a_grown = Sum'(a) <<< AGrow;
  assign b_grown = Sum'(b) <<< BGrow;
  assign sum = Subtract ? a_grown - b_grown : a_grown + b_grown;

  mote_finish #(
      .InWidth(Sum),
      .InFraction(Fraction),
      .OutSigned(YSigned),
      .OutWidth(YWidth),
      .OutFraction(YFraction),
      .Nearest(Nearest),
      .Saturate(Saturate),
      .InRegister(Refine)
  ) finish_u (
      .clk_i,
      .x_i(sum),
      .y_o
  );

endmodule
