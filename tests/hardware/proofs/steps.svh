// module mote_steps  ObsWidth=4
// within 12
// twin   && next_valid_q && !out_q[1] -> && next_valid_q
// twin   assign obs_ready_o = !next_valid_q; -> assign obs_ready_o = 1'b1;
//
// Every observation begins one step, in order, and stands until the next step begins; at most two steps are ahead of their
// estimates; a run begins as many steps as it was told and is busy until the last estimate has left. Assumed: a filter
// tells that a step is through once, and gives an estimate only for a step that has begun, the last one marked.
  logic [15:0] steps_q, taken_q;
  logic [1:0] waiting_q;  // observations that came and have begun no step
  logic [ObsWidth-1:0] first_q, second_q, before_q;
  logic came, stood_q;
  logic [15:0] t_before_q;
  assign came = obs_valid_i && obs_ready_o;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {steps_q, taken_q, waiting_q} <= '0;
      stood_q <= 1'b0;
    end else begin
      if (starts_o) steps_q <= steps_i;
      taken_q   <= starts_o ? '0 : taken_q + 16'(est_taken_i);
      waiting_q <= waiting_q + 2'(came) - 2'(begins_o);
      stood_q   <= !begins_o && !starts_o;
    end
  end
  logic [ObsWidth-1:0] first_d;
  assign first_d = begins_o ? second_q : first_q;
  always_ff @(posedge clk_i) begin
    first_q  <= came && waiting_q == 2'(begins_o) ? obs_i : first_d;
    if (came && waiting_q != 2'(begins_o)) second_q <= obs_i;
    before_q   <= begins_o ? first_q : obs_o;
    t_before_q <= t_o;
  end
  logic after_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_comb begin
    if ($initstate) assume (!rst_ni);
    if (rst_ni) begin
      assume (!(free_i && idle_q));
      assume (!(est_taken_i && out_q == '0));
      assume (est_last_i == (taken_q + 16'd1 == steps_q));
      assert (waiting_q == 2'(next_valid_q));
      assert (out_q <= 2'd2);
      if (begins_o) assert (waiting_q == 2'd1 && busy_o && left_q != '0);
      if (next_valid_q) assert (next_obs_q == first_q);
      if (after_q) assert (obs_o == before_q);
      if (stood_q) assert (t_o == t_before_q);
      assert (busy_o == (taken_q != steps_q));
      assert (t_o + left_q == steps_q && t_o <= steps_q);
      assert (taken_q + 16'(out_q) == t_o && taken_q <= t_o);
    end
  end
