// mote_convert: mote_resize for a number that may be unsigned; drops, keeps or adds bits without a register.
//
// timing  latency 0
// twin    Convert in mote/hardware/choice.hpp
module mote_convert #(
    parameter bit ASigned = 1'b1,
    parameter int AWidth = 18,
    parameter int AFraction = 10,
    parameter bit YSigned = 1'b1,
    parameter int YWidth = 18,
    parameter int YFraction = 8,
    parameter bit Nearest = 1'b1,
    parameter bit Saturate = 1'b1
) (
    input  logic              clk_i,
    input  logic [AWidth-1:0] a_i,
    output logic [YWidth-1:0] y_o
);

  logic unused_clk;
  assign unused_clk = clk_i;

  mote_resize #(
      .InWidth(AWidth + 1),
      .InFraction(AFraction),
      .OutSigned(YSigned),
      .OutWidth(YWidth),
      .OutFraction(YFraction),
      .Nearest(Nearest),
      .Saturate(Saturate)
  ) resize_u (
      .x_i({ASigned && a_i[AWidth-1], a_i}),
      .y_o
  );

endmodule
