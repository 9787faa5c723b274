// The end of a pipeline that cannot stop, as an AXI4-Stream: a queue that has room for all that is under way.
//
// range   issue_i only while room_o; word_i and last_i come Latency cycles after their issue
// timing  a word a clock while it is taken; a word shows the cycle after it came
module mote_stream_out #(
    parameter int unsigned Width   = 16,
    parameter int unsigned Latency = 8,
    localparam int unsigned Depth  = 1 << $clog2(Latency + 4),
    localparam int unsigned Count  = $clog2(Depth) + 1
) (
    input  logic             clk_i,
    input  logic             rst_ni,
    // what goes in
    output logic             room_o,
    input  logic             issue_i,
    input  logic [Width-1:0] word_i,
    input  logic             last_i,
    // what comes out
    output logic             valid_o,
    input  logic             ready_i,
    output logic [Width-1:0] word_o,
    output logic             last_o
);
  logic arrives, empty, taken, unused_full;
  logic [Count-1:0] owed_q;  // under way or waiting
  assign room_o  = owed_q != Count'(Depth);
  assign valid_o = !empty;
  assign taken   = valid_o && ready_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) owed_q <= '0;
    else owed_q <= owed_q + Count'(issue_i) - Count'(taken);
  end
  mote_valid #(.Depth(Latency)) u_arrives (.clk_i, .rst_ni, .valid_i(issue_i), .valid_o(arrives));
  mote_fifo #(.Width(Width + 1), .Depth(Depth)) u_words (
      .clk_i, .rst_ni, .clear_i(1'b0),
      .push_i(arrives), .word_i({last_i, word_i}),
      .pop_i(taken), .word_o({last_o, word_o}),
      .empty_o(empty), .full_o(unused_full));
endmodule
