// module mote_offspring  At=6 Width=17
// within 8
// free   $mul $mem_v2
// twin   assign read_at = {~bank_q, row_q}; -> assign read_at = {bank_q, row_q};
// twin   if (begins) reads_q <= 1'b1; -> if (write_i) reads_q <= 1'b1;
//
// A weight is read only after it was written by the step that is read, and not written again before. One slot of one bank is
// followed. Assumed: a step writes n_i weights and tells the last; n_i stands.
  (* anyconst *) logic [At-1:0] followed;
  (* anyconst *) logic bank;
  (* anyconst *) count_t n;
  logic fresh_q;   // the slot holds a weight of the step that is written (while its bank is), or of the one before
  logic after_q;   // a step has been written
  logic writes_it, reads_it;
  assign writes_it = write_i && write_at == {bank, followed[At-1:1]} && written_q[0] == followed[0];
  assign reads_it = reads && read_at == {bank, followed[At-1:1]} && {1'b0, followed} < n_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {fresh_q, after_q} <= '0;
    else begin
      if (last_i) after_q <= 1'b1;
      if (last_i && bank_q != bank) fresh_q <= 1'b0;
      else if (writes_it) fresh_q <= 1'b1;
    end
  end
  always_comb begin
    if ($initstate) assume (!rst_ni);
    if (rst_ni) begin
      assume (n_i == n && n != '0 && n <= (At + 1)'(1 << At));
      assume (last_i == (write_i && written_q + (At + 1)'(1) == n_i));
      assert (!(reads_it && writes_it));
      if (reads_it) assert (fresh_q && bank != bank_q);
      assert (written_q < n_i);
      if (reads_q) assert (after_q);
      if (bank_q == bank) assert (fresh_q == ({1'b0, followed} < written_q));
      else if (after_q) assert (fresh_q == ({1'b0, followed} < n_i));
    end
  end
