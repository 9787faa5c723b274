// module mote_children  Lanes=1 At=3
// within 12
// twin   end_q == next_q -> end_q == child_q
// twin   moves = row_valid_q && (!valid_o || ready_i) -> moves = row_valid_q
//
// Every child has the first particle whose end is above it for a parent, in order, and what is offered stays until it is
// taken; a row is taken only where one is. One child of any number is followed. Assumed: rows have children, and come after
// the first clear_i.
  (* anyconst *) count_t followed;
  count_t given_q, known_q;
  logic found_q, offered_q, cleared_q;
  logic [At-1:0] wanted_q, parent_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {given_q, known_q} <= '0;
      {found_q, offered_q} <= '0;
    end else if (clear_i) begin
      {given_q, known_q} <= '0;
      {found_q, offered_q} <= '0;
    end else begin
      given_q <= given_q + (At + 1)'(valid_o && ready_i);
      if (row_pop_o) known_q <= ends_i[At+1+:At+1];
      if (row_pop_o && known_q <= followed && followed < ends_i[At+1+:At+1]) found_q <= 1'b1;
      offered_q <= valid_o && !ready_i;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) cleared_q <= 1'b0;
    else cleared_q <= cleared_q || clear_i;
  end
  always_ff @(posedge clk_i) begin
    if (row_pop_o && known_q <= followed && followed < ends_i[At+1+:At+1]) wanted_q <= {row_i, ends_i[0+:At+1] <= followed};
    parent_q <= parent_o;
  end
  always_comb begin
    if ($initstate) assume (!rst_ni);
    if (rst_ni) begin
      if (row_valid_i) assume (cleared_q);
      if (row_valid_i) assume (ends_i[At+1+:At+1] > known_q && ends_i[At+1+:At+1] <= (At + 1)'(1 << At));
      if (row_valid_i) assume (ends_i[0+:At+1] >= known_q && ends_i[0+:At+1] <= ends_i[At+1+:At+1]);
      if (row_pop_o) assert (row_valid_i);
      if (offered_q) assert (valid_o && parent_o == parent_q);
      if (valid_o && given_q == followed) assert (found_q && parent_o == wanted_q);
    end
  end
  if (Lanes == 1) begin : gen_invariants
    always_comb begin
      if (rst_ni && !cleared_q) assert (!gen_lane_alone.row_valid_q && !valid_o && known_q == '0 && given_q == '0 && !found_q);
      if (rst_ni && cleared_q) begin
        assert (gen_lane_alone.child_q == given_q + (At + 1)'(valid_o));
        assert (gen_lane_alone.next_q == gen_lane_alone.child_q + (At + 1)'(1));
        assert (known_q <= (At + 1)'(1 << At) && given_q <= known_q && gen_lane_alone.child_q <= known_q);
        assert (found_q == (followed < known_q));
        if (gen_lane_alone.row_valid_q) assert (gen_lane_alone.end_q == known_q && gen_lane_alone.child_q < known_q);
        else assert (gen_lane_alone.child_q == known_q);
        if (gen_lane_alone.row_valid_q && followed >= gen_lane_alone.child_q && found_q)
          assert (wanted_q == {gen_lane_alone.row_q, gen_lane_alone.even_end_q <= followed});
      end
    end
  end
