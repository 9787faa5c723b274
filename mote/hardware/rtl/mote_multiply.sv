// mote_multiply: the product of two numbers in any formats, in a third.
//
// equation  y = a * b
// formats   a, b, y: signed or not, Width bits, Fraction of them after the point. One DSP48E1 takes 25 x 18 signed bits
// range     the product is exact before it is rounded; mote_resize says how y is rounded, saturates or wraps
// timing    latency mote_product's (2 by DSP blocks, ceil(log2 of b's bits) by Logic), and 1 with Saturate or where Logic rounds;
//           one product a clock. Operands should come from registers, as the operators' results do
// twin      Product in mote/hardware/arithmetic.hpp
module mote_multiply #(
    parameter bit ASigned = 1'b1,
    parameter int AWidth = 18,
    parameter int AFraction = 10,
    parameter bit BSigned = 1'b1,
    parameter int BWidth = 18,
    parameter int BFraction = 10,
    parameter bit YSigned = 1'b1,
    parameter int YWidth = 18,
    parameter int YFraction = 10,
    parameter bit Nearest = 1'b1,
    parameter bit Saturate = 1'b1,
    parameter bit Logic = 1'b0
) (
    input  logic              clk_i,
    input  logic [AWidth-1:0] a_i,
    input  logic [BWidth-1:0] b_i,
    output logic [YWidth-1:0] y_o
);

  localparam int AWide = ASigned ? AWidth : AWidth + 1;
  localparam int BWide = BSigned ? BWidth : BWidth + 1;

  localparam int Drop = AFraction + BFraction - YFraction;
  localparam bit Rounds = Nearest && Drop > 0;
  localparam logic signed [AWide+BWide-1:0] Half = Rounds && !Logic ? (AWide + BWide)'(1) <<< (Drop - 1) : '0;

  logic signed [AWide+BWide-1:0] p;

  mote_product #(
      .AWidth(AWide),
      .BWidth(BWide),
      .Offset(Half),
      .Logic (Logic)
  ) product_u (
      .clk_i,
      .a_i(AWide'(a_i)),
      .b_i(BWide'(b_i)),
      .p_o(p)
  );

  if (Saturate || (Rounds && Logic)) begin : gen_finish
    mote_finish #(
        .InWidth(AWide + BWide),
        .InFraction(AFraction + BFraction),
        .OutSigned(YSigned),
        .OutWidth(YWidth),
        .OutFraction(YFraction),
        .Nearest(Rounds && Logic),
        .Saturate(Saturate),
        .InRegister(1'b0)
    ) finish_u (
        .clk_i,
        .x_i(p),
        .y_o
    );
  end else begin : gen_bits
    mote_resize #(
        .InWidth(AWide + BWide),
        .InFraction(AFraction + BFraction),
        .OutSigned(YSigned),
        .OutWidth(YWidth),
        .OutFraction(YFraction),
        .Nearest(1'b0),
        .Saturate(1'b0)
    ) resize_u (
        .x_i(p),
        .y_o
    );
  end

endmodule
