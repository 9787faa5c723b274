// mote_scale: divides a number by a power of two that comes with it.
//
// equation  y = m * 2^-s, rounded to nearest (ties up)
// formats   m: unsigned, MWidth bits, MFraction of them after the point; s: unsigned; y: unsigned
// range     y saturates
// timing    latency 3 (shift by multiples of 8, shift by 0 to 7, rounding), one number a clock
// twin      Scale in mote/hardware/shift.hpp
module mote_scale #(
    parameter int MWidth = 18,
    parameter int MFraction = 17,
    parameter int SWidth = 5,
    parameter int YWidth = 18,
    parameter int YFraction = 12
) (
    input  logic              clk_i,
    input  logic [MWidth-1:0] m_i,
    input  logic [SWidth-1:0] s_i,
    output logic [YWidth-1:0] y_o
);

  // One bit below y's last decides the rounding; what lies below that one is dropped.
  localparam int Lift = YFraction + 1 > MFraction ? YFraction + 1 - MFraction : 0;
  localparam int Drop = MFraction > YFraction + 1 ? MFraction - YFraction - 1 : 0;
  localparam int Wide = MWidth + Lift - Drop > YWidth + 2 ? MWidth + Lift - Drop : YWidth + 2;
  localparam int Bits = SWidth < 4 ? 4 : SWidth;

  logic [MWidth+Lift-1:0] lifted;
  logic [Bits-1:0] s;
  logic [Wide-1:0] coarse_q, fine_q;
  logic [2:0] s_q;
  logic [Wide:0] rounded;
  logic [YWidth-1:0] y;

  assign lifted = (MWidth + Lift)'(m_i) << Lift;
  assign s = Bits'(s_i);
  assign rounded = {1'b0, fine_q} + 1;
  assign y = |rounded[Wide:YWidth+1] ? '1 : rounded[YWidth:1];
  logic unused_bits;
  assign unused_bits = ^{lifted, rounded[0]};

  always_ff @(posedge clk_i) begin
    coarse_q <= Wide'(lifted[MWidth+Lift-1:Drop]) >> {s[Bits-1:3], 3'b000};
    s_q <= s[2:0];
    fine_q <= coarse_q >> s_q;
    y_o <= y;
  end

endmodule
