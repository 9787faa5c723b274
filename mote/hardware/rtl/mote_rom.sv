// mote_rom: a table that never changes.
//
// timing  latency 2 (address to memory, memory to output register), one word a clock
module mote_rom #(
    parameter int AddressWidth = 8,
    parameter int Width = 18,
    parameter File = "table.hex"  // one word a line, hexadecimal, 2^AddressWidth lines
) (
    input  logic                    clk_i,
    input  logic [AddressWidth-1:0] address_i,
    output logic [       Width-1:0] word_o
);

  logic [Width-1:0] words[1<<AddressWidth];
  logic [Width-1:0] word_q;
  initial $readmemh(File, words);

  always_ff @(posedge clk_i) begin
    word_q <= words[address_i];
    word_o <= word_q;
  end

endmodule
