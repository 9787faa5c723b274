// mote_negate_if: a number or its negative.
//
// equation  y = s ? -a : a
// formats   a, y: signed or not, Width bits, one fraction
// range     y saturates
// timing    latency 1, one number a clock
// twin      NegateIf in mote/hardware/choice.hpp
module mote_negate_if #(
    parameter bit ASigned = 1'b1,
    parameter int AWidth = 18,
    parameter bit YSigned = 1'b1,
    parameter int YWidth = 18
) (
    input  logic              clk_i,
    input  logic              s_i,
    input  logic [AWidth-1:0] a_i,
    output logic [YWidth-1:0] y_o
);

  logic signed [AWidth+1:0] a, signed_a;
  assign a = {{2{ASigned && a_i[AWidth-1]}}, a_i};
  assign signed_a = s_i ? -a : a;

  mote_finish #(
      .InWidth(AWidth + 2),
      .InFraction(0),
      .OutSigned(YSigned),
      .OutWidth(YWidth),
      .OutFraction(0),
      .Nearest(1'b0),
      .Saturate(1'b1),
      .InRegister(1'b0)
  ) finish_u (
      .clk_i,
      .x_i(signed_a),
      .y_o
  );

endmodule
