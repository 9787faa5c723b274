// mote_rom_pair: a table that never changes, read at two addresses a clock: a block of memory with two ports.
//
// timing  latency 2 (address to memory, memory to output register), two words a clock
module mote_rom_pair #(
    parameter int AddressWidth = 10,
    parameter int Width = 18,
    parameter File = "table.hex"  // one word a line, hexadecimal, 2^AddressWidth lines
) (
    input  logic                    clk_i,
    input  logic [AddressWidth-1:0] address0_i,
    input  logic [AddressWidth-1:0] address1_i,
    output logic [       Width-1:0] word0_o,
    output logic [       Width-1:0] word1_o
);

  logic [Width-1:0] words[1<<AddressWidth];
  logic [Width-1:0] word0_q, word1_q;
  initial $readmemh(File, words);

  always_ff @(posedge clk_i) begin
    word0_q <= words[address0_i];
    word1_q <= words[address1_i];
    word0_o <= word0_q;
    word1_o <= word1_q;
  end

endmodule
