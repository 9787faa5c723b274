// mote_product_tree: a product as a tree of adders: that with the upper half of b's bits and that with the lower half, added.
//
// equation  p = a * b; b is signed with Signed
// timing    latency Depth >= ceil(log2 BWidth), one product a clock; a stage is one adder of about AWidth + BWidth/2 bits
// twin      C++'s own product
module mote_product_tree #(
    parameter int AWidth = 18,
    parameter int BWidth = 18,
    parameter int Depth  = 5,
    parameter bit Signed = 1'b1
) (
    input  logic                            clk_i,
    input  logic signed [       AWidth-1:0] a_i,
    input  logic        [       BWidth-1:0] b_i,
    output logic signed [AWidth+BWidth-1:0] p_o
);

  localparam int Whole = AWidth + BWidth;

  if (Depth == 1 && BWidth == 1) begin : gen_bit
    always_ff @(posedge clk_i) p_o <= !b_i[0] ? '0 : Signed ? -(Whole'(a_i)) : Whole'(a_i);
  end else if (Depth == 1) begin : gen_pair
    logic signed [Whole-1:0] low, high;
    assign low  = b_i[0] ? Whole'(a_i) : '0;
    assign high = b_i[1] ? Whole'(a_i) <<< 1 : '0;
    always_ff @(posedge clk_i) p_o <= Signed ? low - high : low + high;
  end else begin : gen_halves
    localparam int Half = 1 << (Depth - 1);
    if (BWidth <= Half) begin : gen_one
      logic signed [Whole-1:0] p;
      mote_product_tree #(
          .AWidth(AWidth),
          .BWidth(BWidth),
          .Depth (Depth - 1),
          .Signed(Signed)
      ) one_u (
          .clk_i,
          .a_i,
          .b_i,
          .p_o(p)
      );
      always_ff @(posedge clk_i) p_o <= p;
    end else begin : gen_two
      logic signed [AWidth+Half-1:0] low;
      logic signed [Whole-Half-1:0] high;
      mote_product_tree #(
          .AWidth(AWidth),
          .BWidth(Half),
          .Depth (Depth - 1),
          .Signed(1'b0)
      ) low_u (
          .clk_i,
          .a_i,
          .b_i(b_i[Half-1:0]),
          .p_o(low)
      );
      mote_product_tree #(
          .AWidth(AWidth),
          .BWidth(BWidth - Half),
          .Depth (Depth - 1),
          .Signed(Signed)
      ) high_u (
          .clk_i,
          .a_i,
          .b_i(b_i[BWidth-1:Half]),
          .p_o(high)
      );
      always_ff @(posedge clk_i) p_o <= Whole'(low) + (Whole'(high) <<< Half);
    end
  end

endmodule
