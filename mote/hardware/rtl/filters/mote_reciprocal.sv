// A divisor as a factor: the reciprocal of a positive number to 17 bits, never too large.
//
//   x = floor(divisor 2^zeros / 2^(Width - 18)), so 2^17 <= x < 2^18;   2^35 (1 - 2^-15) < reciprocal_o x <= 2^35
//   by a table over the 8 bits of x below its leading one, and the chord between its entries
//
// formats  divisor_i: unsigned, not 0; reciprocal_o: unsigned, 18 bits; zeros_o: the leading zeros of the divisor
// timing   latency 5 (zeros_o: 1), initiation interval 1
// golden   Reciprocal in mote/hardware/filters/offspring.hpp
module mote_reciprocal #(
    parameter int unsigned Width = 34,
    localparam int unsigned ZerosWidth = $clog2(Width)
) (
    input  logic                  clk_i,
    input  logic [Width-1:0]      divisor_i,
    output logic [ZerosWidth-1:0] zeros_o,
    output logic [17:0]           reciprocal_o
);
  // Entry i: floor(2^26 / (2^8 + i)) - 1, and how far the next one is below it.
  function automatic logic [17:0] entry(input int unsigned i);
    entry = 18'(32'd67108864 / (32'd256 + i) - 32'd1);
  endfunction
  logic [27:0] table_rom[256];
  initial for (int i = 0; i < 256; i++) table_rom[i] = {entry(i), 10'(entry(i) - entry(i + 1))};

  logic [ZerosWidth-1:0] zeros;
  always_comb begin
    zeros = '0;
    for (int i = 0; i < Width; i++) if (divisor_i[i]) zeros = ZerosWidth'(Width - 1 - i);
  end
  logic [Width-1:0] divisor_q, shifted;
  logic [16:0] below_q;
  logic [8:0]  rest_q;
  logic [27:0] entry_q;
  logic [17:0] base_q, base2_q;
  logic [9:0]  slope_q;
  logic [18:0] product_q;
  assign shifted = divisor_q << zeros_o;
  assign {base_q, slope_q} = entry_q;
  always_ff @(posedge clk_i) begin
    divisor_q    <= divisor_i;
    zeros_o      <= zeros;
    below_q      <= shifted[Width-2-:17];
    rest_q       <= below_q[8:0];
    entry_q      <= table_rom[below_q[16:9]];
    product_q    <= 19'(slope_q) * 19'(rest_q);
    base2_q      <= base_q;
    reciprocal_o <= base2_q - 18'(product_q[18:9]) - 18'd1;
  end
  logic unused_bits;
  assign unused_bits = ^{shifted, product_q[8:0]};
endmodule
