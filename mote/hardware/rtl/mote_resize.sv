// mote_resize: moves a number to another fixed-point format, without a register.
//
// equation  y = x in units of 2^-OutFraction: rounded down, or to the nearest (ties up) with Nearest
// formats   x: signed, InWidth bits, InFraction of them after the point; y: OutWidth bits, OutFraction after the point
// range     Saturate: y is the closest number that the format holds; else y wraps, and the caller knows that it fits
// timing    combinational: rounding and saturation are one carry chain and one multiplexer
// twin      resized() in mote/hardware/format.hpp
module mote_resize #(
    parameter int InWidth = 36,
    parameter int InFraction = 20,
    parameter bit OutSigned = 1'b1,
    parameter int OutWidth = 18,
    parameter int OutFraction = 10,
    parameter bit Nearest = 1'b1,
    parameter bit Saturate = 1'b1
) (
    input  logic signed [ InWidth-1:0] x_i,
    output logic        [OutWidth-1:0] y_o
);

  localparam int Drop = InFraction > OutFraction ? InFraction - OutFraction : 0;
  localparam int Grow = OutFraction > InFraction ? OutFraction - InFraction : 0;
  localparam int Carried = InWidth + Grow + 1;  // one bit more, for the carry of rounding
  localparam int Wide = Carried > OutWidth + 1 + Drop ? Carried : OutWidth + 1 + Drop;
  localparam int Kept = Wide - Drop;

  logic signed [Wide-1:0] aligned;
  logic signed [Kept-1:0] kept;
  assign aligned = Wide'(x_i) <<< Grow;

  if (Drop == 0) begin : gen_exact
    assign kept = aligned;
  end else if (Nearest) begin : gen_nearest
    logic [Drop-1:0] unused_bits;
    assign {kept, unused_bits} = aligned + (Wide'(1) <<< (Drop - 1));
  end else begin : gen_down
    logic [Drop-1:0] unused_bits;
    assign {kept, unused_bits} = aligned;
  end

  if (!Saturate) begin : gen_wrap
    logic [Kept-OutWidth-1:0] unused_top;
    assign {unused_top, y_o} = kept;
  end else if (OutSigned) begin : gen_signed
    logic fits;
    assign fits = (&kept[Kept-1:OutWidth-1]) || !(|kept[Kept-1:OutWidth-1]);
    assign y_o  = fits ? kept[OutWidth-1:0] : {kept[Kept-1], {(OutWidth - 1) {~kept[Kept-1]}}};
  end else begin : gen_unsigned
    logic fits;
    assign fits = !(|kept[Kept-1:OutWidth]);
    assign y_o  = fits ? kept[OutWidth-1:0] : {OutWidth{~kept[Kept-1]}};
  end

endmodule
