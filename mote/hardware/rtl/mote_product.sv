// mote_product: the full product of two signed words whose bits come from registers.
//
// equation  p = a * b + Offset, AWidth + BWidth bits, exact; the offset (rounding) costs nothing in a DSP block, and is 0 with Logic
// timing    Logic = 0: latency 2 (a DSP block's M and P registers; a DSP48E1 takes 25 x 18 bits), one product a clock
//           Logic = 1: latency max(1, ceil(log2 BWidth)), a tree of adders with a register behind each, for devices without DSP blocks
// twin      C++'s own product
module mote_product #(
    parameter int AWidth = 25,
    parameter int BWidth = 18,
    parameter logic signed [AWidth+BWidth-1:0] Offset = '0,
    parameter bit Logic  = 1'b0
) (
    input  logic                            clk_i,
    input  logic signed [       AWidth-1:0] a_i,
    input  logic signed [       BWidth-1:0] b_i,
    output logic signed [AWidth+BWidth-1:0] p_o
);

  if (Logic) begin : gen_tree
    mote_product_tree #(
        .AWidth(AWidth),
        .BWidth(BWidth),
        .Depth(BWidth > 2 ? $clog2(BWidth) : 1),
        .Signed(1'b1)
    ) tree_u (
        .clk_i,
        .a_i,
        .b_i,
        .p_o
    );
  end else begin : gen_dsp
    logic signed [AWidth+BWidth-1:0] m_q;
    always_ff @(posedge clk_i) begin
      m_q <= a_i * b_i;
      p_o <= m_q + Offset;
    end
  end

endmodule
