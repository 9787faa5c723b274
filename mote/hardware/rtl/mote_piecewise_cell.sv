// mote_piecewise_cell: the segment of a number and its polynomial's coefficients, see mote_piecewise.
//
// formats   x, u, c0, c1, c2: mote_piecewise's; delta: the place in the segment, in units of 2^-DeltaBits from its middle; side: of the
//           centre, 0 with Fold 0; c2 is 0 with Degree 1
// timing    latency 2 (Fold 1..3) or 1 (Fold 4) + 3 (with octaves) + 2; one number a clock
// twin      PiecewiseCell in mote/hardware/piecewise.hpp
module mote_piecewise_cell #(
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
    parameter Table = "table.hex"
) (
    input  logic                        clk_i,
    input  logic        [   XWidth-1:0] x_i,
    output logic signed [  C0Width-1:0] c0_o,
    output logic signed [  C1Width-1:0] c1_o,
    output logic signed [  C2Width-1:0] c2_o,
    output logic signed [DeltaBits-1:0] delta_o,
    output logic                        side_o
);

  localparam int Regions = UWidth - Bottom + 1;
  localparam int RegionBits = $clog2(Regions);
  localparam int AddressWidth = SegmentBits + RegionBits + (Fold == 1 ? 1 : 0);
  localparam int WordWidth = C0Width + C1Width + (Degree == 1 ? 0 : C2Width);

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

  // Its polynomial.
  logic [WordWidth-1:0] word;
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
      .d_o(delta_o)
  );
  mote_delay #(
      .Width(1),
      .Depth((Regions > 1 ? 3 : 0) + 2)
  ) side_o_u (
      .clk_i,
      .d_i(side),
      .d_o(side_o)
  );
  assign c0_o = word[C0Width-1:0];
  assign c1_o = word[C0Width+:C1Width];
  if (Degree == 1) begin : gen_line
    assign c2_o = '0;
  end else begin : gen_parabola
    assign c2_o = word[C0Width+C1Width+:C2Width];
  end

endmodule
