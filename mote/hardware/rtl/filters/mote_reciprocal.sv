// A divisor as a factor: the reciprocal of a positive number to 17 bits, never too large.
//
//   x = floor(divisor 2^zeros / 2^(Width - 18)), so 2^17 <= x < 2^18;   2^35 (1 - 2^-15) < reciprocal_o x <= 2^35
//   by a table over the 8 bits of x below its leading one, and the line to its next entry
//
// formats  divisor_i: unsigned; reciprocal_o: unsigned, 18 bits; zeros_o: the leading zeros of the divisor
// range    the divisor has at most MostZeros leading zeros
// timing   load_i takes the divisor; reciprocal_o stands 5 cycles later, zeros_o a cycle later, until the next
// golden   reciprocal_of in mote/hardware/filters/offspring.hpp
module mote_reciprocal #(
    parameter int unsigned Width = 34,
    parameter int unsigned MostZeros = 17,
    localparam int unsigned ZerosWidth = $clog2(Width)
) (
    input  logic                  clk_i,
    input  logic                  load_i,
    input  logic [Width-1:0]      divisor_i,
    output logic [ZerosWidth-1:0] zeros_o,
    output logic [17:0]           reciprocal_o
);
  // Entry i: floor(2^26 / (2^8 + i)) - 1, as the line between entries is less than 1 above the curve; and minus what the next
  // one is below it.
  function automatic logic [17:0] entry(input int unsigned i);
    entry = 18'(32'd67108864 / (32'd256 + i) - 32'd1);
  endfunction
  logic [28:0] table_rom[256];
  initial for (int i = 0; i < 256; i++) table_rom[i] = {entry(i), 11'(entry(i + 1)) - 11'(entry(i))};

  // Leading zeros: those of each byte, of the first byte that has a one.
  localparam int unsigned Last = MostZeros / 8;
  function automatic logic [2:0] zeros_of(input logic [7:0] byte_in);
    zeros_of = '0;
    for (int i = 0; i < 8; i++) if (byte_in[i]) zeros_of = 3'(7 - i);
  endfunction
  logic [ZerosWidth-1:0] zeros;
  always_comb begin
    zeros = {(ZerosWidth - 3)'(Last), zeros_of(divisor_i[Width-1-8*Last-:8])};
    for (int k = Last - 1; k >= 0; k--)
      if (divisor_i[Width-1-8*k-:8] != '0) zeros = {(ZerosWidth - 3)'(k), zeros_of(divisor_i[Width-1-8*k-:8])};
  end

  logic [Width-1:0] divisor_q, shifted;
  logic [16:0] below_q;
  logic [8:0]  rest_q;
  logic [28:0] entry_q;
  logic [17:0] base_q;
  logic signed [10:0] slope;
  logic signed [20:0] product_q;
  logic signed [27:0] line_q;
  assign shifted = divisor_q << zeros_o;
  assign slope = entry_q[10:0];
  assign reciprocal_o = line_q[26:9];
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      divisor_q <= divisor_i;
      zeros_o   <= zeros;
    end
    below_q   <= shifted[Width-2-:17];
    rest_q    <= below_q[8:0];
    entry_q   <= table_rom[below_q[16:9]];
    product_q <= 21'(slope) * 21'($signed({1'b0, rest_q}));
    base_q    <= entry_q[28:11];
    line_q    <= 28'($signed({1'b0, base_q, 9'b0})) + 28'(product_q);
  end
  logic unused_bits;
  assign unused_bits = ^{shifted, line_q[27], line_q[8:0]};
endmodule
