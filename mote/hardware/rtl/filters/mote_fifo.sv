// A queue whose oldest word shows.
//
// range   push_i never on a full queue, pop_i never on an empty one; clear_i empties it
// timing  a word shows the cycle after its push
module mote_fifo #(
    parameter int unsigned Width = 16,
    parameter int unsigned Depth = 16,
    localparam int unsigned At   = $clog2(Depth)
) (
    input  logic             clk_i,
    input  logic             rst_ni,
    input  logic             clear_i,
    input  logic             push_i,
    input  logic [Width-1:0] word_i,
    input  logic             pop_i,
    output logic [Width-1:0] word_o,
    output logic             empty_o,
    output logic             full_o
);
  logic [Width-1:0] words[Depth];
  logic [At:0] in_q, out_q;
  always_ff @(posedge clk_i) if (push_i) words[in_q[At-1:0]] <= word_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {in_q, out_q} <= '0;
    else if (clear_i) {in_q, out_q} <= '0;
    else begin
      if (push_i) in_q <= in_q + (At + 1)'(1);
      if (pop_i) out_q <= out_q + (At + 1)'(1);
`ifndef SYNTHESIS
      assert (!(push_i && full_o));
      assert (!(pop_i && empty_o));
`endif
    end
  end
  assign word_o  = words[out_q[At-1:0]];
  assign empty_o = in_q == out_q;
  assign full_o  = in_q - out_q == (At + 1)'(Depth);
endmodule
