// mote_select: one of two words.
//
// equation  y = s ? a : b
// timing    latency 1, one word a clock
// twin      Select in mote/hardware/choice.hpp
module mote_select #(
    parameter int Width = 18
) (
    input  logic             clk_i,
    input  logic             s_i,
    input  logic [Width-1:0] a_i,
    input  logic [Width-1:0] b_i,
    output logic [Width-1:0] y_o
);

  always_ff @(posedge clk_i) y_o <= s_i ? a_i : b_i;

endmodule
