// mote_multiply_add: a product and a sum, at which several products may take turns.
//
// equation  y = a * b + c, the lowest YWidth bits
// formats   all signed. One DSP48E1 takes 25 x 18 + 48 bits
// timing    latency 2 by DSP blocks (M and P registers), by Logic ceil(log2 BWidth), at least 1, and 1; one result a clock. Operands
//           come from registers, or from a choice among some
// twin      MultiplyAdd in mote/hardware/arithmetic.hpp
module mote_multiply_add #(
    parameter int AWidth = 25,
    parameter int BWidth = 18,
    parameter int CWidth = 2,
    parameter int YWidth = 43,
    parameter bit Logic  = 1'b0
) (
    input  logic                     clk_i,
    input  logic signed [AWidth-1:0] a_i,
    input  logic signed [BWidth-1:0] b_i,
    input  logic signed [CWidth-1:0] c_i,
    output logic signed [YWidth-1:0] y_o
);

  localparam int Depth = Logic && BWidth > 2 ? $clog2(BWidth) : 1;

  logic signed [AWidth+BWidth-1:0] product;
  logic signed [CWidth-1:0] c;

  if (Logic) begin : gen_tree
    mote_product #(
        .AWidth(AWidth),
        .BWidth(BWidth),
        .Logic (1'b1)
    ) product_u (
        .clk_i,
        .a_i,
        .b_i,
        .p_o(product)
    );
  end else begin : gen_dsp
    always_ff @(posedge clk_i) product <= a_i * b_i;
  end

  mote_delay #(
      .Width(CWidth),
      .Depth(Depth)
  ) c_u (
      .clk_i,
      .d_i(c_i),
      .d_o(c)
  );

  always_ff @(posedge clk_i) y_o <= YWidth'(product) + YWidth'(c);

  if (YWidth < AWidth + BWidth) begin : gen_bits
    logic unused_bits;
    assign unused_bits = ^product;
  end

endmodule
