// mote_piecewise: a function of one number, by polynomials of degree 1 or 2 on segments that shrink towards a centre.
//
// equation  y = c0 + (c1 + c2 d) d, d in [-1/2, 1/2) the place in the segment; c0, c1, c2 from the table's word {c2, c1, c0}
//           u = place of x from the centre by Fold: 0 x from the least x on; 1 |x - Centre|, a table for each side; 2 the same, y odd;
//           3 the same, y even; 4 y odd about -1/2: u = x, or its complement where x is negative
//           [0, 2^Bottom) and each octave [2^k, 2^(k+1)) above are cut into 2^SegmentBits segments
// formats   x: signed or not, XWidth bits; u: UWidth bits, larger ones saturate; d: DeltaBits; c0, c1, c2: signed, of Guard bits
//           below y's last, half of which c0 contains; products are rounded down to Guard bits
// range     y saturates
// timing    latency 2 (Fold 1..3) or 1 (Fold 4) + 3 (with octaves) + 2 + Degree (1 + mote_product's) + 1; one y a clock
// twin      Piecewise in mote/hardware/piecewise.hpp, which also writes the table
module mote_piecewise #(
    parameter bit XSigned = 1'b0,
    parameter int XWidth = 16,
    parameter int Fold = 0,
    parameter int Centre = 0,
    parameter int UWidth = 16,
    parameter int Bottom = 16,
    parameter int SegmentBits = 4,
    parameter int DeltaBits = 12,
    parameter int Degree = 2,
    parameter int C0Width = 20,
    parameter int C1Width = 18,
    parameter int C2Width = 16,
    parameter int Guard = 4,
    parameter bit YSigned = 1'b1,
    parameter int YWidth = 18,
    parameter bit Logic = 1'b0,
    parameter Table = "table.hex"
) (
    input  logic              clk_i,
    input  logic [XWidth-1:0] x_i,
    output logic [YWidth-1:0] y_o
);

  localparam int Product = Logic ? (DeltaBits > 2 ? $clog2(DeltaBits) : 1) : 2;
  localparam int SlopeWidth = Degree == 1 ? C1Width : (C1Width > C2Width ? C1Width : C2Width) + 1;
  localparam int SumWidth = (C0Width > SlopeWidth ? C0Width : SlopeWidth) + 1;
  localparam int ResultWidth = SumWidth - Guard + 1;
  localparam int Known = Degree * (Product + 1);  // clocks from the coefficients to the sum

  // The segment, its coefficients and the place in it.
  logic signed [C0Width-1:0] c0_cell;
  logic signed [C1Width-1:0] c1_cell;
  logic signed [C2Width-1:0] c2_cell;
  logic signed [DeltaBits-1:0] delta;
  logic side;
  mote_piecewise_cell #(
      .XSigned(XSigned),
      .XWidth(XWidth),
      .Fold(Fold),
      .Centre(Centre),
      .UWidth(UWidth),
      .Bottom(Bottom),
      .SegmentBits(SegmentBits),
      .DeltaBits(DeltaBits),
      .Degree(Degree),
      .C0Width(C0Width),
      .C1Width(C1Width),
      .C2Width(C2Width),
      .Table(Table)
  ) cell_u (
      .clk_i,
      .x_i,
      .c0_o(c0_cell),
      .c1_o(c1_cell),
      .c2_o(c2_cell),
      .delta_o(delta),
      .side_o(side)
  );

  // The polynomial.
  logic signed [SlopeWidth-1:0] slope;
  logic signed [DeltaBits-1:0] delta_of_slope;
  if (Degree == 1) begin : gen_line
    logic unused_bend;
    assign unused_bend = ^c2_cell;
    assign slope = c1_cell;
    assign delta_of_slope = delta;
  end else begin : gen_parabola
    logic signed [C2Width+DeltaBits-1:0] bend;
    logic signed [C1Width-1:0] c1;
    logic unused_bits;
    assign unused_bits = ^bend[DeltaBits-1:0];
    mote_product #(
        .AWidth(C2Width),
        .BWidth(DeltaBits),
        .Logic (Logic)
    ) bend_u (
        .clk_i,
        .a_i(c2_cell),
        .b_i(delta),
        .p_o(bend)
    );
    mote_delay #(
        .Width(C1Width),
        .Depth(Product)
    ) c1_u (
        .clk_i,
        .d_i(c1_cell),
        .d_o(c1)
    );
    mote_delay #(
        .Width(DeltaBits),
        .Depth(Product + 1)
    ) again_u (
        .clk_i,
        .d_i(delta),
        .d_o(delta_of_slope)
    );
    always_ff @(posedge clk_i) slope <= SlopeWidth'(c1) + SlopeWidth'($signed(bend[C2Width+DeltaBits-1:DeltaBits]));
  end

  logic signed [SlopeWidth+DeltaBits-1:0] rise;
  logic signed [C0Width-1:0] c0;
  logic signed [SumWidth-1:0] sum_q;
  logic unused_rise;
  assign unused_rise = ^rise[DeltaBits-1:0];
  mote_product #(
      .AWidth(SlopeWidth),
      .BWidth(DeltaBits),
      .Logic (Logic)
  ) rise_u (
      .clk_i,
      .a_i(slope),
      .b_i(delta_of_slope),
      .p_o(rise)
  );
  mote_delay #(
      .Width(C0Width),
      .Depth(Product * Degree + Degree - 1)
  ) c0_u (
      .clk_i,
      .d_i(c0_cell),
      .d_o(c0)
  );
  always_ff @(posedge clk_i) sum_q <= SumWidth'(c0) + SumWidth'($signed(rise[SlopeWidth+DeltaBits-1:DeltaBits]));

  // Rounding, the sign of an odd function, saturation.
  logic negative;
  logic signed [SumWidth-Guard-1:0] kept;
  logic signed [ResultWidth-1:0] result;
  logic [YWidth-1:0] y;
  logic unused_guard;
  assign unused_guard = ^sum_q[Guard-1:0];
  assign kept = sum_q[SumWidth-1:Guard];
  if (Fold == 2 || Fold == 4) begin : gen_odd
    mote_delay #(
        .Width(1),
        .Depth(Known)
    ) side_u (
        .clk_i,
        .d_i(side),
        .d_o(negative)
    );
  end else begin : gen_as_it_is
    logic unused_side;
    assign unused_side = side;
    assign negative = 1'b0;
  end
  assign result = negative ? -(ResultWidth'(kept)) : ResultWidth'(kept);
  mote_resize #(
      .InWidth(ResultWidth),
      .InFraction(0),
      .OutSigned(YSigned),
      .OutWidth(YWidth),
      .OutFraction(0),
      .Nearest(1'b0),
      .Saturate(1'b1)
  ) resize_u (
      .x_i(result),
      .y_o(y)
  );
  always_ff @(posedge clk_i) y_o <= y;

endmodule
