// Uniform 32-bit words: L'Ecuyer's combined Tausworthe generator taus88, one word a cycle.
//
//   word_o is the present word; a cycle with advance_i moves to the next
//
// formats  32 bits, unsigned; period about 2^88
// seeding  the three components are mixed from (Seed, Stream), so that streams are unrelated; reset returns to them
// timing   word_o: a XOR of three registers; initiation interval 1
// golden   mote/hardware/words.hpp
// source   L'Ecuyer 1996, Math. Comp. 65, p. 203
module mote_words #(
    parameter logic [63:0] Seed   = 64'd1,
    parameter int unsigned Stream = 0
) (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        advance_i,
    output logic [31:0] word_o
);
  // Steele, Lea & Flood 2014: SplitMix64.
  function automatic logic [31:0] mixed(input logic [63:0] number);
    logic [63:0] z;
    z = Seed + (64'(Stream) * 64'd3 + number) * 64'h9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 64'hBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 64'h94D049BB133111EB;
    z = z ^ (z >> 31);
    mixed = z[63:32];
  endfunction
  // A component must not be below 2, 8, 16: one bit is set.
  localparam logic [31:0] FirstA = mixed(64'd1) | 32'd2;
  localparam logic [31:0] FirstB = mixed(64'd2) | 32'd8;
  localparam logic [31:0] FirstC = mixed(64'd3) | 32'd16;

  logic [31:0] a_q, b_q, c_q, a_d, b_d, c_d;
  assign a_d = {a_q[19:1], a_q[18:6] ^ a_q[31:19]};
  assign b_d = {b_q[27:3], b_q[29:23] ^ b_q[31:25]};
  assign c_d = {c_q[14:4], c_q[28:8] ^ c_q[31:11]};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      a_q <= FirstA;
      b_q <= FirstB;
      c_q <= FirstC;
    end else if (advance_i) begin
      a_q <= a_d;
      b_q <= b_d;
      c_q <= c_d;
    end
  end
  assign word_o = a_q ^ b_q ^ c_q;
endmodule
