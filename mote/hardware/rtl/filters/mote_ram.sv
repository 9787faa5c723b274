// A memory with a port to write and a port to read.
//
//   read_word_o(n) = memory[read_at_i(n - 2)] as it was before cycle n - 2's write
//
// timing  reads: latency 2 (the array, then its output register); writes: visible to reads of the next cycle
module mote_ram #(
    parameter int unsigned Width = 36,
    parameter int unsigned Words = 1024,
    localparam int unsigned At = $clog2(Words)
) (
    input  logic             clk_i,
    input  logic             write_i,
    input  logic [At-1:0]    write_at_i,
    input  logic [Width-1:0] write_word_i,
    input  logic [At-1:0]    read_at_i,
    output logic [Width-1:0] read_word_o
);
  (* ram_style = "block" *)
  logic [Width-1:0] memory[Words];
  logic [Width-1:0] read_q;
  always_ff @(posedge clk_i) begin
    if (write_i) memory[write_at_i] <= write_word_i;
    read_q <= memory[read_at_i];
    read_word_o <= read_q;
  end
endmodule
