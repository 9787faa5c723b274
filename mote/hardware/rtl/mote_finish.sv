// mote_finish: mote_resize with a register behind it, and one before it where that pays.
//
// timing  latency 1, with InRegister 2; one word a clock
// twin    resized() in mote/hardware/format.hpp
module mote_finish #(
    parameter int InWidth = 36,
    parameter int InFraction = 20,
    parameter bit OutSigned = 1'b1,
    parameter int OutWidth = 18,
    parameter int OutFraction = 10,
    parameter bit Nearest = 1'b1,
    parameter bit Saturate = 1'b1,
    parameter bit InRegister = 1'b1
) (
    input  logic                       clk_i,
    input  logic signed [ InWidth-1:0] x_i,
    output logic        [OutWidth-1:0] y_o
);

  logic signed [InWidth-1:0] x;
  logic [OutWidth-1:0] y;

  mote_delay #(
      .Width(InWidth),
      .Depth(InRegister ? 1 : 0)
  ) before_u (
      .clk_i,
      .d_i(x_i),
      .d_o(x)
  );

  mote_resize #(
      .InWidth(InWidth),
      .InFraction(InFraction),
      .OutSigned(OutSigned),
      .OutWidth(OutWidth),
      .OutFraction(OutFraction),
      .Nearest(Nearest),
      .Saturate(Saturate)
  ) resize_u (
      .x_i(x),
      .y_o(y)
  );

  always_ff @(posedge clk_i) y_o <= y;

endmodule
