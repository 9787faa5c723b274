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

  localparam int Regions = UWidth - Bottom + 1;
  localparam int RegionBits = $clog2(Regions);
  localparam int AddressWidth = SegmentBits + RegionBits + (Fold == 1 ? 1 : 0);
  localparam int Product = Logic ? (DeltaBits > 2 ? $clog2(DeltaBits) : 1) : 2;
  localparam int SlopeWidth = Degree == 1 ? C1Width : (C1Width > C2Width ? C1Width : C2Width) + 1;
  localparam int SumWidth = (C0Width > SlopeWidth ? C0Width : SlopeWidth) + 1;
  localparam int ResultWidth = SumWidth - Guard + 1;
  localparam int WordWidth = C0Width + C1Width + (Degree == 1 ? 0 : C2Width);
  localparam int Known = (Regions > 1 ? 3 : 0) + 2 + Degree * (Product + 1);  // clocks from u to the sum

  // The place from the centre, and the side of it.
  logic [UWidth-1:0] u;
  logic side;
  if (Fold == 0) begin : gen_plain
    assign u = x_i ^ (XSigned ? XWidth'(1) << (XWidth - 1) : '0);
    assign side = 1'b0;
  end else if (Fold == 4) begin : gen_mirrored
    always_ff @(posedge clk_i) begin
      u <= x_i[XWidth-2:0] ^ {UWidth{x_i[XWidth-1]}};
      side <= x_i[XWidth-1];
    end
  end else begin : gen_folded
    localparam int Far = XWidth + 2;
    logic signed [Far-1:0] from_q;
    logic [Far-1:0] size;
    assign size = from_q[Far-1] ? -from_q : from_q;
    always_ff @(posedge clk_i) begin
      from_q <= Far'($signed({XSigned && x_i[XWidth-1], x_i})) - Far'(Centre);
      side <= from_q[Far-1];
      u <= |size[Far-1:UWidth] ? '1 : size[UWidth-1:0];
    end
  end

  // The segment, as an address, and the place in it.
  logic [AddressWidth-1:0] address;
  logic [DeltaBits-1:0] place;
  if (Regions == 1) begin : gen_uniform
    logic [UWidth+DeltaBits-1:0] wide;
    assign wide = {u, {DeltaBits{1'b0}}};
    assign place = wide[UWidth+DeltaBits-SegmentBits-1-:DeltaBits];
    logic unused_bits;
    assign unused_bits = ^wide;
    if (Fold == 1) begin : gen_sides
      assign address = {side, u[UWidth-1-:SegmentBits]};
    end else begin : gen_one
      assign address = u[UWidth-1-:SegmentBits];
    end
  end else begin : gen_octaves
    localparam int ShiftBits = RegionBits + 2;
    localparam int Field = UWidth - 1 + SegmentBits + DeltaBits;  // with zeros enough behind
    logic [RegionBits-1:0] region, region_q, region_qq;
    logic [ShiftBits-1:0] shift;
    logic [UWidth-1:0] u_q, coarse_q, fine;
    logic [1:0] fine_q;
    logic [Field-1:0] field;
    always_comb begin
      region = '0;
      for (int r = 1; r < Regions; r++) if (u[Bottom+r-1]) region = RegionBits'(r);
    end
    assign shift = ShiftBits'(UWidth - Bottom) - (region_q == '0 ? ShiftBits'(1) : ShiftBits'(region_q));
    assign fine  = coarse_q << fine_q;
    assign field = {fine[UWidth-2:0], {(SegmentBits + DeltaBits) {1'b0}}};
    logic unused_bits;
    assign unused_bits = ^{fine[UWidth-1], field};
    always_ff @(posedge clk_i) begin
      region_q <= region;
      u_q <= u;
      region_qq <= region_q;
      coarse_q <= u_q << {shift[ShiftBits-1:2], 2'b00};
      fine_q <= shift[1:0];
      place <= field[Field-SegmentBits-1-:DeltaBits];
    end
    if (Fold == 1) begin : gen_sides
      logic side_qq;
      mote_delay #(
          .Width(1),
          .Depth(2)
      ) side_u (
          .clk_i,
          .d_i(side),
          .d_o(side_qq)
      );
      always_ff @(posedge clk_i) address <= {side_qq, region_qq, field[Field-1-:SegmentBits]};
    end else begin : gen_one
      always_ff @(posedge clk_i) address <= {region_qq, field[Field-1-:SegmentBits]};
    end
  end

  // The polynomial.
  logic [WordWidth-1:0] word;
  logic signed [DeltaBits-1:0] delta;  // when the word arrives
  mote_rom #(
      .AddressWidth(AddressWidth),
      .Width(WordWidth),
      .File(Table)
  ) rom_u (
      .clk_i,
      .address_i(address),
      .word_o(word)
  );
  mote_delay #(
      .Width(DeltaBits),
      .Depth(2)
  ) delta_u (
      .clk_i,
      .d_i({~place[DeltaBits-1], place[DeltaBits-2:0]}),
      .d_o(delta)
  );

  logic signed [SlopeWidth-1:0] slope;
  logic signed [DeltaBits-1:0] delta_of_slope;
  if (Degree == 1) begin : gen_line
    assign slope = word[C0Width+:C1Width];
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
        .a_i(word[C0Width+C1Width+:C2Width]),
        .b_i(delta),
        .p_o(bend)
    );
    mote_delay #(
        .Width(C1Width),
        .Depth(Product)
    ) c1_u (
        .clk_i,
        .d_i(word[C0Width+:C1Width]),
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
      .d_i(word[C0Width-1:0]),
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
