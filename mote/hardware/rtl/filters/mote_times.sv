// mote_times: a product in a filter, exact; bits come from registers.
//
// equation  p = a * b, AWidth + BWidth bits: signed where a or b is
// timing    latency Product: 1 by a multiplier and its register; else a tree of adders (mote_product_tree), Product >= 2 and
//           >= ceil(log2 BWidth), for devices without multipliers. One product a clock
// golden    C++'s own product
module mote_times #(
    parameter int unsigned AWidth  = 24,
    parameter int unsigned BWidth  = 17,
    parameter bit          ASigned = 1'b0,
    parameter bit          BSigned = 1'b0,
    parameter int unsigned Product = 1
) (
    input  logic                     clk_i,
    input  logic [       AWidth-1:0] a_i,
    input  logic [       BWidth-1:0] b_i,
    output logic [AWidth+BWidth-1:0] p_o
);
  localparam int unsigned Whole = AWidth + BWidth;
  if (Product == 1) begin : gen_multiplier
    logic [Whole-1:0] product_q;
    if (ASigned || BSigned) begin : gen_signed
      logic signed [AWidth:0] a;
      logic signed [BWidth:0] b;
      assign a = $signed({ASigned && a_i[AWidth-1], a_i});
      assign b = $signed({BSigned && b_i[BWidth-1], b_i});
      always_ff @(posedge clk_i) product_q <= Whole'(a) * Whole'(b);
    end else begin : gen_unsigned
      always_ff @(posedge clk_i) product_q <= Whole'(a_i) * Whole'(b_i);
    end
    assign p_o = product_q;
  end else begin : gen_tree
    logic signed [Whole:0] product;
    mote_product_tree #(.AWidth(AWidth + 1), .BWidth(BWidth), .Depth(Product), .Signed(BSigned)) u_tree (
        .clk_i, .a_i($signed({ASigned && a_i[AWidth-1], a_i})), .b_i, .p_o(product));
    assign p_o = product[Whole-1:0];
    logic unused_sign;
    assign unused_sign = product[Whole];
  end
endmodule
