// module mote_fifo  Width=3 Depth=4
// within 10
// twin   full_o  = in_q - out_q == (At + 1)'(Depth) -> full_o  = in_q - out_q == (At + 1)'(Depth + 1)
// twin   words[out_q[At-1:0]]; -> words[in_q[At-1:0]];
//
// A queue never holds more than its depth and gives words in the order in which they came: beside it, a row of words that
// moves up. Assumed: its range.
  logic [Depth*Width-1:0] row_q, row_d;
  logic [At:0] held_q, moved_up;
  assign moved_up = held_q - (At + 1)'(pop_i);
  always_comb begin
    row_d = pop_i ? row_q >> Width : row_q;
    for (int i = 0; i < Depth; i++) if (push_i && moved_up == (At + 1)'(i)) row_d[i*Width+:Width] = word_i;
  end
  always_ff @(posedge clk_i) row_q <= row_d;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) held_q <= '0;
    else if (clear_i) held_q <= '0;
    else held_q <= moved_up + (At + 1)'(push_i);
  end
  always_comb begin
    if ($initstate) assume (!rst_ni);
    if (rst_ni) begin
      assume (!(push_i && full_o));
      assume (!(pop_i && empty_o));
      assert (held_q == in_q - out_q);
      assert (held_q <= (At + 1)'(Depth));
      assert (full_o == (held_q == (At + 1)'(Depth)));
      assert (empty_o == (held_q == '0));
      if (!empty_o) assert (word_o == row_q[Width-1:0]);
    end
  end
  for (genvar i = 0; i < Depth; i++) begin : gen_kept
    logic [At-1:0] place;
    assign place = out_q[At-1:0] + At'(i);
    always_comb if (rst_ni && held_q > (At + 1)'(i)) assert (words[place] == row_q[i*Width+:Width]);
  end
