// module mote_estimate  Dims=1 ValueWidth=2 Width=3 At=1 Extra=1 ScaleWidth=2
// within 14
// twin   take = pending_q && !busy_q && !valid_o -> take = pending_q && !busy_q
// twin   else if (ready_i) valid_o <= 1'b0; -> else valid_o <= 1'b0;
//
// The stream of estimates: what is offered stays, unchanged, until it is taken, and no step's sums are lost. Assumed: at
// most two steps are ahead of their estimates (mote_steps), and the sums of one are taken before the next is done.
  logic [1:0] ahead_q;
  logic offered_q, came_q;
  logic [Dims*MeanWidth+SumWidth+ScaleWidth+At+1:0] word, word_q;
  assign word = {mean_o, sum_o, scale_o, accepted_o, last_o};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ahead_q   <= '0;
      offered_q <= 1'b0;
    end else begin
      ahead_q   <= ahead_q + 2'(done_i) - 2'(valid_o && ready_i);
      offered_q <= valid_o && !ready_i;
    end
  end
  always_ff @(posedge clk_i) word_q <= word;
  logic [2:0] underway;
  assign underway = 3'(done_q[0]) + 3'(done_q[1]) + 3'(done_q[2]) + 3'(pending_q) + 3'(busy_q) + 3'(valid_o);
  always_comb begin
    if ($initstate) assume (!rst_ni);
    if (rst_ni) begin
      assume (!(done_i && ahead_q == 2'd2));
      assume (!(done_i && |done_q));
      assert (ahead_q <= 2'd2);
      if (offered_q) assert (valid_o && word == word_q);
      assert (!(busy_q && valid_o));
      assert (underway == 3'(ahead_q));
      assert (!(done_q[Wait-1] && pending_q && !take));
      assert (count_q <= CountWidth'(Bits) || !busy_q);
    end
  end
