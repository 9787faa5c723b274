// mote_multiply_constant: the product of a number with a constant, by shifts and additions.
//
// equation  y = a * (Plus - Minus) * 2^-CFraction; Plus and Minus are the constant's signed digits, no bit in both
// formats   a, y: signed or not, Width bits, Fraction of them after the point
// range     the product is exact before it is rounded; mote_resize says how y is rounded, saturates or wraps
// timing    latency 1 + Depth; Depth = max(1, ceil(log2 of the number of digits)). One product a clock
// twin      ConstantProduct in mote/hardware/arithmetic.hpp
module mote_multiply_constant #(
    parameter bit ASigned = 1'b1,
    parameter int AWidth = 18,
    parameter int AFraction = 10,
    parameter int CWidth = 8,
    parameter int CFraction = 6,
    parameter logic [CWidth-1:0] Plus = 8'd65,
    parameter logic [CWidth-1:0] Minus = 8'd4,
    parameter int Depth = 2,
    parameter bit YSigned = 1'b1,
    parameter int YWidth = 18,
    parameter int YFraction = 10,
    parameter bit Nearest = 1'b1,
    parameter bit Saturate = 1'b1
) (
    input  logic              clk_i,
    input  logic [AWidth-1:0] a_i,
    output logic [YWidth-1:0] y_o
);

  localparam int Whole = AWidth + 1 + CWidth;
  localparam int Rows = 1 << Depth;

  // The place of the digit number `row`; CWidth where there are fewer digits.
  function automatic int digit_place(input int row);
    int found;
    digit_place = CWidth;
    found = 0;
    for (int place = 0; place < CWidth; place++) begin
      if (Plus[place] || Minus[place]) begin
        if (found == row) digit_place = place;
        found = found + 1;
      end
    end
  endfunction

  // Node n of the tree adds nodes 2n and 2n + 1, the rows are nodes Rows to 2 Rows - 1.
  logic signed [Whole-1:0] a;
  logic signed [Whole-1:0] node[2*Rows];
  assign a = Whole'($signed({ASigned && a_i[AWidth-1], a_i}));
  assign node[0] = '0;

  for (genvar row = 0; row < Rows; row++) begin : gen_rows
    localparam int Place = digit_place(row);
    if (Place == CWidth) begin : gen_none
      assign node[Rows+row] = '0;
    end else if (Minus[Place]) begin : gen_minus
      assign node[Rows+row] = -(a <<< Place);
    end else begin : gen_plus
      assign node[Rows+row] = a <<< Place;
    end
  end

  for (genvar n = 1; n < Rows; n++) begin : gen_sums
    always_ff @(posedge clk_i) node[n] <= node[2*n] + node[2*n+1];
  end

  mote_finish #(
      .InWidth(Whole),
      .InFraction(AFraction + CFraction),
      .OutSigned(YSigned),
      .OutWidth(YWidth),
      .OutFraction(YFraction),
      .Nearest(Nearest),
      .Saturate(Saturate),
      .InRegister(1'b0)
  ) finish_u (
      .clk_i,
      .x_i(node[1]),
      .y_o
  );

endmodule
