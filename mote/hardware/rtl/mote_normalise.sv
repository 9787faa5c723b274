// mote_normalise: shifts a number to the left until its leading one stands at the top, and another by as many places.
//
// equation  m = x << s, n_o = n_i << s; Even = 0: s = Width - 1 - (place of x's leading one), and 0 places where x = 0 has e = 0
//           Even = 1: s is the greatest even number that keeps all ones of x
//           e = Width - 1 - s with Even = 0 (0 for x = 0: then m = 0), e = s / 2 with Even = 1 (the most for x = 0)
// formats   x, m, n: unsigned, Width bits; Width is even where Even is 1
// timing    latency 3 (place, shift by multiples of 4, shift by 0 to 3), one pair a clock
// twin      Normalise in mote/hardware/shift.hpp
module mote_normalise #(
    parameter int Width = 18,
    parameter int EWidth = 5,
    parameter bit Even = 1'b0
) (
    input  logic              clk_i,
    input  logic [ Width-1:0] x_i,
    input  logic [ Width-1:0] n_i,
    output logic [EWidth-1:0] e_o,
    output logic [ Width-1:0] m_o,
    output logic [ Width-1:0] n_o
);

  localparam int ShiftBits = $clog2(Width) < 3 ? 3 : $clog2(Width);

  logic [ShiftBits-1:0] shift, shift_q;
  logic [EWidth-1:0] e, e_q, e_qq;
  logic [Width-1:0] x_q, n_q, coarse_q, also_q;
  logic [1:0] fine_q;

  always_comb begin
    shift = Even ? ShiftBits'(Width - 2) : ShiftBits'(Width - 1);
    for (int k = 0; k < Width; k++)
      if (x_i[k]) shift = Even ? ShiftBits'((Width - 1 - k) / 2 * 2) : ShiftBits'(Width - 1 - k);
    e = Even ? EWidth'(shift >> 1) : EWidth'(Width - 1) - EWidth'(shift);
  end

  always_ff @(posedge clk_i) begin
    shift_q <= shift;
    e_q <= e;
    x_q <= x_i;
    n_q <= n_i;
    coarse_q <= x_q << {shift_q[ShiftBits-1:2], 2'b00};
    also_q <= n_q << {shift_q[ShiftBits-1:2], 2'b00};
    fine_q <= shift_q[1:0];
    e_qq <= e_q;
    m_o <= coarse_q << fine_q;
    n_o <= also_q << fine_q;
    e_o <= e_qq;
  end

endmodule
