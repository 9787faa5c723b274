// A kept weight as bits of its step's sum: at the scale of the step's last weight, cut, then raised by the sum's leading zeros.
//
//   w = floor((1 + mantissa) 2^(octave - 8 scale + Width)),   share_o(n + 3) = floor(w 2^(zeros - At))
//
// The octave is known modulo 64: it lies less than 56 below 8 scale, or faint_i says that the weight is nothing; from 24 below
// on it is nothing, too.
//
// formats  short_i: {octave mod 64, 12 bits of mantissa}, as mote_weight has it; share_o: unsigned
// range    by_i, level_i and mask_i are mote_scales's. What a sum of Width + At bits with so many leading zeros is made of is
//          below 2^Width
// timing   latency 3, initiation interval 1
// golden   Offspring in mote/hardware/filters/offspring.hpp
module mote_share #(
    parameter int unsigned Width = 24
) (
    input  logic             clk_i,
    input  logic [17:0]      short_i,
    input  logic             faint_i,
    input  logic [5:0]       by_i,
    input  logic [2:0]       level_i,
    input  logic [6:0]       mask_i,
    output logic [Width-1:0] share_o
);
  logic [5:0] down;
  logic [2:0] quanta, fine_q;
  logic [4:0] down_q;
  logic alive_q;
  logic [12:0] mantissa_q;
  logic [Width-1:0] coarse_q;
  assign down = by_i - short_i[17:12];
  assign quanta = level_i - short_i[17:15];
  always_ff @(posedge clk_i) begin
    alive_q    <= !faint_i && quanta < 3'd3 && !down[5];
    down_q     <= down[4:0];
    mantissa_q <= {1'b1, short_i[11:0]};
    coarse_q   <= alive_q ? {mantissa_q, {(Width - 13) {1'b0}}} >> {down_q[4:3], 3'b0} : '0;
    fine_q     <= down_q[2:0];
    share_o    <= (coarse_q >> fine_q) & {{(Width - 7) {1'b1}}, ~mask_i};
  end
endmodule
