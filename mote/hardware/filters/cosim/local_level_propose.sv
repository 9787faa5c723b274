// A random walk seen in noise, as the circuits' tests have it: states of 18 bits with 5 fraction bits, noise by the sum
// of a word's four bytes.
//
//   x_0 = 1120 + 316.2 z_0,   x' = x + 38.3 z_1,   lw = -(y - x)^2 / (2 15099) log2(e)
//
// timing  latencies 4 and 4, initiation interval 1
// golden  models.hpp
module local_level_propose (
    input  logic              clk_i,
    input  logic              first_i,
    input  logic signed [17:0] state_i,
    input  logic [1:0][31:0]  words_i,
    output logic signed [17:0] state_o
);
  function automatic logic signed [10:0] normal(input logic [31:0] word);
    return $signed(11'(word[7:0]) + 11'(word[15:8]) + 11'(word[23:16]) + 11'(word[31:24]) - 11'd510);
  endfunction
  logic signed [10:0] prior_q, step_q;
  logic signed [17:0] base_q, base2_q;
  logic signed [27:0] prior2_q, step2_q;
  logic signed [20:0] sum_q;
  always_ff @(posedge clk_i) begin
    prior_q  <= first_i ? normal(words_i[0]) : 11'sd0;
    step_q   <= normal(words_i[1]);
    base_q   <= first_i ? 18'sd35840 : state_i;
    prior2_q <= 28'(prior_q) * 28'sd17527;
    step2_q  <= 28'(step_q) * 28'sd2125;
    base2_q  <= base_q;
    sum_q    <= 21'(base2_q) + 21'(prior2_q >>> 8) + 21'(step2_q >>> 8);
    state_o  <= sum_q > 21'sd131071 ? 18'sd131071 : sum_q < -21'sd131072 ? -18'sd131072 : 18'(sum_q);
  end
endmodule
