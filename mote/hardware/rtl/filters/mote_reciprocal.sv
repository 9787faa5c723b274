// A divisor as a factor: the reciprocal of a positive number to 13 bits, never too large.
//
//   x = floor(divisor 2^zeros / 2^(Width - 18)), so 2^17 <= x < 2^18;   2^35 (1 - 2^-13) < reciprocal_o x <= 2^35
//   by a table over the 6 bits of x below its leading one: the tangent of 2^35 / x in the middle of each segment
//
// formats  divisor_i: unsigned; reciprocal_o: unsigned, 18 bits; zeros_o: the leading zeros of the divisor
// range    the divisor has at most MostZeros leading zeros
// timing   load_i takes the divisor; reciprocal_o stands 4 + Product cycles later, zeros_o a cycle later, until the next.
//          Product: mote_times's
// golden   reciprocal_of in mote/hardware/filters/offspring.hpp
module mote_reciprocal #(
    parameter int unsigned Width = 34,
    parameter int unsigned MostZeros = 17,
    parameter int unsigned Product = 1,
    localparam int unsigned ZerosWidth = $clog2(Width)
) (
    input  logic                  clk_i,
    input  logic                  load_i,
    input  logic [Width-1:0]      divisor_i,
    output logic [ZerosWidth-1:0] zeros_o,
    output logic [17:0]           reciprocal_o
);
  // Entry i, with m = 129 + 2 i: floor(2^25 (m + 1) / m^2), where the tangent begins, and -ceil(2^26 / m^2), what it gains.
  function automatic logic [30:0] entry(input int unsigned i);
    longint unsigned middle;
    middle = 64'd129 + 64'd2 * 64'(i);
    entry = {18'(((middle + 64'd1) << 25) / (middle * middle)),
             -13'((64'd67108864 + middle * middle - 64'd1) / (middle * middle))};
  endfunction
  logic [30:0] table_rom[64];
  initial for (int i = 0; i < 64; i++) table_rom[i] = entry(i);

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
  logic [10:0] rest_q;
  logic [30:0] entry_q;
  logic [17:0] base_q;
  logic [23:0] product;
  logic signed [29:0] line_q;
  assign shifted = divisor_q << zeros_o;
  mote_times #(.AWidth(13), .BWidth(11), .ASigned(1'b1), .Product(Product)) u_product (
      .clk_i, .a_i(entry_q[12:0]), .b_i(rest_q), .p_o(product));
  assign reciprocal_o = line_q[28:11];
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      divisor_q <= divisor_i;
      zeros_o   <= zeros;
    end
    below_q   <= shifted[Width-2-:17];
    rest_q    <= below_q[10:0];
    entry_q   <= table_rom[below_q[16:11]];
    base_q    <= entry_q[30:13];
    line_q    <= 30'($signed({1'b0, base_q, 11'b0})) + 30'($signed(product));
  end
  logic unused_bits;
  assign unused_bits = ^{shifted, line_q[29], line_q[10:0]};
endmodule
