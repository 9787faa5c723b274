// A word, Depth cycles later.
//
//   word_o(n) = word_i(n - Depth);  Depth = 0 is a wire
//
// timing  latency Depth, initiation interval 1; no reset, so that it becomes shift registers
module mote_delay #(
    parameter int unsigned Width = 1,
    parameter int unsigned Depth = 1
) (
    input  logic             clk_i,
    input  logic [Width-1:0] word_i,
    output logic [Width-1:0] word_o
);
  if (Depth == 0) begin : gen_wire
    logic unused_clk;
    assign unused_clk = clk_i;
    assign word_o = word_i;
  end else begin : gen_line
    logic [Width-1:0] line_q[Depth];
    always_ff @(posedge clk_i) begin
      line_q[0] <= word_i;
      for (int unsigned i = 1; i < Depth; i++) line_q[i] <= line_q[i-1];
    end
    assign word_o = line_q[Depth-1];
  end
endmodule
