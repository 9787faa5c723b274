// Two growth models seen together, as the circuits' tests have them: states of 18 bits with 10 fraction bits, the drift by
// a coarse table, noise by the sum of a word's four bytes; the cosine comes with the observations.
//
//   x' = g(x) + c + 3.16 z,   g(x) = x/2 + 25x/(1 + x^2),   lw = -sum (y - x^2/20)^2 / 2 log2(e), saturated
//
// timing  latencies 6 and 5, initiation interval 1
// golden  models.hpp
module growth_propose #(
    parameter Table = "growth.hex"
) (
    input  logic               clk_i,
    input  logic               first_i,
    input  logic signed [17:0] cosine_i,
    input  logic signed [17:0] state_i,
    input  logic        [31:0] word_i,
    output logic signed [17:0] state_o
);
  logic signed [17:0] table_rom[1024];
  initial $readmemh(Table, table_rom);
  logic [9:0] at_q;
  logic signed [10:0] normal_q;
  logic signed [17:0] drift_q;
  logic signed [27:0] noise_q;
  logic signed [20:0] sum_q;
  logic signed [17:0] state4_q, state5_q;
  logic unused_state;
  assign unused_state = ^state_i[7:0];
  always_ff @(posedge clk_i) begin
    at_q     <= state_i[17:8];
    normal_q <= $signed(11'(word_i[7:0]) + 11'(word_i[15:8]) + 11'(word_i[23:16]) + 11'(word_i[31:24]) - 11'd510);
    drift_q  <= first_i ? 18'sd0 : table_rom[at_q];
    noise_q  <= 28'(normal_q) * 28'sd5608;
    sum_q    <= 21'(drift_q) + 21'(cosine_i) + 21'(noise_q >>> 8);
    state4_q <= sum_q > 21'sd131071 ? 18'sd131071 : sum_q < -21'sd131072 ? -18'sd131072 : 18'(sum_q);
    state5_q <= state4_q;
    state_o  <= state5_q;
  end
endmodule
