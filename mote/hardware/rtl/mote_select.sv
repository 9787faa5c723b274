// mote_select: one of two words.
//
// equation  y = s ? a : b
// timing    latency 1, 0 without Register; one word a clock
// twin      Select in mote/hardware/choice.hpp
module mote_select #(
    parameter int Width = 18,
    parameter bit Register = 1'b1
) (
    input  logic             clk_i,
    input  logic             s_i,
    input  logic [Width-1:0] a_i,
    input  logic [Width-1:0] b_i,
    output logic [Width-1:0] y_o
);

  mote_delay #(
      .Width(Width),
      .Depth(Register ? 1 : 0)
  ) out_u (
      .clk_i,
      .d_i(s_i ? a_i : b_i),
      .d_o(y_o)
  );

endmodule
