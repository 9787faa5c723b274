// mote_rom: a table that never changes.
//
// timing  latency 2 (address to memory, memory to output register), 1 without OutRegister; one word a clock
module mote_rom #(
    parameter int AddressWidth = 8,
    parameter int Width = 18,
    parameter bit OutRegister = 1'b1,
    parameter bit Logic = 1'b0,  // in look-up tables, however large it is
    parameter File = "table.hex"  // one word a line, hexadecimal, 2^AddressWidth lines
) (
    input  logic                    clk_i,
    input  logic [AddressWidth-1:0] address_i,
    output logic [       Width-1:0] word_o
);

  logic [Width-1:0] word_q;
  if (Logic) begin : gen_logic
    (* ram_style = "registers", rom_style = "distributed" *)  // the first for Yosys, the other for Vivado
    logic [Width-1:0] words[1<<AddressWidth];
    initial $readmemh(File, words);
    always_ff @(posedge clk_i) word_q <= words[address_i];
  end else begin : gen_any
    logic [Width-1:0] words[1<<AddressWidth];
    initial $readmemh(File, words);
    always_ff @(posedge clk_i) word_q <= words[address_i];
  end
  mote_delay #(
      .Width(Width),
      .Depth(OutRegister ? 1 : 0)
  ) out_u (
      .clk_i,
      .d_i(word_q),
      .d_o(word_o)
  );

endmodule
