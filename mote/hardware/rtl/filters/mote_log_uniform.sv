// What a Metropolis chain compares by: minus the binary logarithm of a uniform word.
//
//   drop_o = -log2(word_i / 2^32) = (z + 1) - log2(1 + m),   word_i = 2^(31 - z) (1 + m)
//   log2(1 + m) = m + c(m), c by a table over the 7 leading bits of m
//
// formats  drop_o: unsigned, 6 integer and 10 fraction bits; below 33, so it cannot overflow. Word 0 counts as 2^-1
// error    below 2^-8 octave
// timing   latency 5, initiation interval 1
// golden   log_drop in mote/hardware/filters/weights.hpp
module mote_log_uniform #(
    parameter Table = "log2.hex"
) (
    input  logic        clk_i,
    input  logic [31:0] word_i,
    output logic [15:0] drop_o
);
  logic [6:0] table_rom[128];
  initial $readmemh(Table, table_rom);

  // Leading zeros: those of each byte, then of the first byte that has a one.
  function automatic logic [2:0] zeros_of(input logic [7:0] byte_in);
    zeros_of = '0;
    for (int i = 0; i < 8; i++) if (byte_in[i]) zeros_of = 3'(7 - i);
  endfunction
  logic [3:0] some_q;  // bytes with a one, the leading byte first
  logic [4*3-1:0] zeros_q;
  logic [1:0] first;
  always_comb begin
    first = 2'd3;
    for (int k = 2; k >= 0; k--) if (some_q[k]) first = 2'(k);
  end

  logic [5:0]  zeros2_q, zeros3_q, zeros4_q;
  logic [31:0] word_q, coarse_q;
  logic [9:0]  mantissa_q;
  logic [10:0] log_q;
  logic [31:0] fine;
  assign fine = coarse_q << zeros2_q[2:0];
  always_ff @(posedge clk_i) begin
    for (int k = 0; k < 4; k++) begin
      some_q[k]       <= word_i[31-8*k-:8] != '0;
      zeros_q[3*k+:3] <= zeros_of(word_i[31-8*k-:8]);
    end
    word_q     <= word_i;
    zeros2_q   <= some_q == '0 ? 6'd32 : {1'b0, first, zeros_q[3*32'(first)+:3]};
    coarse_q   <= word_q << {first, 3'b0};
    zeros3_q   <= zeros2_q;
    mantissa_q <= fine[30:21];
    zeros4_q   <= zeros3_q;
    log_q      <= 11'(mantissa_q) + 11'(table_rom[mantissa_q[9:3]]);
    drop_o     <= {zeros4_q + 6'd1, 10'b0} - 16'(log_q);
  end
  logic unused_fine;
  assign unused_fine = ^{fine[31], fine[20:0]};
endmodule
