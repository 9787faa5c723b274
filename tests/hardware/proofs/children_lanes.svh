// module mote_children  Lanes=2 At=4
// module mote_children  Lanes=4 At=4
// within 12
// twin   if (goes && !before_q[l]) -> if (goes)
// twin   before_q <= known_q[Lanes-1] ? '0 : known_q; -> before_q <= known_q;
// twin   || b_valid_q && above[(l+1)*2*Many-1]; -> || above[(l+1)*2*Many-1];
// twin   assign goes = !valid_o || ready_i; -> assign goes = 1'b1;
// twin   assign row_pop_o = row_valid_i && !(a_stays && b_stays); -> assign row_pop_o = row_valid_i;
// twin   a_valid_q <= a_stays || b_stays || row_pop_o; -> a_valid_q <= a_stays || row_pop_o;
//
// Lanes children a cycle: every child has the first particle whose end is above it for a parent, groups come once each and in
// order, what is offered stays until it is taken, and all whole groups of the rows taken have been offered when nothing is
// under way; a row or a group goes with every look, so that none waits for ever. One child of any number is followed.
// Assumed: rows have children, and come after the first clear_i.
  localparam int unsigned LogLanes = $clog2(Lanes);
  localparam int unsigned GroupWidth = At - LogLanes + 1;
  (* anyconst *) logic [At-1:0] followed;
  count_t ended_q, gone_q;  // the ends of the rows taken, and of those that are through
  logic [GroupWidth-1:0] given_q;
  logic found_q, offered_q, cleared_q;
  logic [At-1:0] wanted_q, wanted;
  logic [Lanes*At-1:0] parents_q;
  count_t row_end;
  assign row_end = ends_i[(Many-1)*(At+1)+:At+1];

  // The first particle of a row, whose ends are given, that has its end above the child that is followed.
  function automatic logic [$clog2(Many)-1:0] first_above(input logic [Many*(At+1)-1:0] ends);
    first_above = '0;
    for (int i = Many - 1; i >= 0; i--)
      if (ends[i*(At+1)+:At+1] > {1'b0, followed}) first_above = $clog2(Many)'(i);
  endfunction
  function automatic logic in_order(input logic [Many*(At+1)-1:0] ends, input count_t from);
    in_order = ends[0+:At+1] >= from && ends[(Many-1)*(At+1)+:At+1] > from;
    for (int i = 1; i < Many; i++) if (ends[i*(At+1)+:At+1] < ends[(i-1)*(At+1)+:At+1]) in_order = 1'b0;
    if (ends[(Many-1)*(At+1)+:At+1] > (At + 1)'(1 << At)) in_order = 1'b0;
  endfunction

  logic takes_it;  // the row that has it
  assign takes_it = row_pop_o && ended_q <= {1'b0, followed} && {1'b0, followed} < row_end;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ended_q, gone_q, given_q} <= '0;
      {found_q, offered_q} <= '0;
    end else if (clear_i) begin
      {ended_q, gone_q, given_q} <= '0;
      {found_q, offered_q} <= '0;
    end else begin
      given_q <= given_q + GroupWidth'(valid_o && ready_i);
      if (row_pop_o) ended_q <= row_end;
      if (gen_lanes.b_valid_q && gen_lanes.b_through) gone_q <= b_end;
      else if (gen_lanes.a_through) gone_q <= a_end;
      if (takes_it) found_q <= 1'b1;
      offered_q <= valid_o && !ready_i;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) cleared_q <= 1'b0;
    else cleared_q <= cleared_q || clear_i;
  end
  always_ff @(posedge clk_i) begin
    if (takes_it) wanted_q <= {row_i, first_above(ends_i)};
    parents_q <= parent_o;
  end

  // ---- what is promised
  logic [LogLanes-1:0] lane;
  logic [GroupWidth-1:0] group;
  logic [At-1:0] parent;
  assign {group, lane} = {1'b0, followed};
  assign parent = parent_o[32'(lane)*At+:At];
  logic idle;
  assign idle = !gen_lanes.a_valid_q && !gen_lanes.looked_q && !valid_o;
  always_comb begin
    if ($initstate) assume (!rst_ni);
    if (rst_ni) begin
      if (row_valid_i) assume (cleared_q && in_order(ends_i, ended_q));
      if (row_pop_o) assert (row_valid_i);
      if (offered_q) assert (valid_o && parent_o == parents_q);
      if (valid_o && given_q == group) assert (found_q && parent == wanted_q);
      if (valid_o) assert (given_q < ended_q[At:LogLanes]);
      if (idle) assert (given_q == ended_q[At:LogLanes]);
      if (gen_lanes.moves) assert (gen_lanes.known[Lanes-1] || gen_lanes.a_through);
    end
  end

  // ---- invariants
  count_t a_end, b_end;
  assign a_end = gen_lanes.a_ends_q[(Many-1)*(At+1)+:At+1];
  assign b_end = gen_lanes.b_ends_q[(Many-1)*(At+1)+:At+1];
  logic complete;             // the group looked at a cycle before
  logic [Lanes-1:0] so_far;   // children of the present group that earlier looks know
  logic [GroupWidth-1:0] behind;            // the group that is behind the rows
  assign complete = gen_lanes.looked_q && gen_lanes.known_q[Lanes-1];
  assign so_far = complete ? '0 : gen_lanes.looked_q ? gen_lanes.known_q : gen_lanes.before_q;
  assign behind = gen_lanes.group_q - GroupWidth'(complete);
  logic [2*Many-1:0] above;
  logic [$clog2(2*Many)-1:0] place;
  assign above = gen_lanes.above_q[32'(lane)*2*Many+:2*Many];
  always_comb begin
    place = '0;
    for (int k = $clog2(2 * Many) - 1; k >= 0; k--)
      if (!above[place|$clog2(2*Many)'((1<<k)-1)]) place[k] = 1'b1;
    wanted = {place[$clog2(Many)] ? gen_lanes.b_looked_q : gen_lanes.a_looked_q, place[$clog2(Many)-1:0]};
  end
  always_comb begin
    if (rst_ni && !cleared_q) assert (!gen_lanes.a_valid_q && !gen_lanes.b_valid_q && !gen_lanes.looked_q && !valid_o &&
                                      ended_q == '0 && gone_q == '0 && given_q == '0 && !found_q);
    if (rst_ni && cleared_q) begin
      // counts
      assert (gen_lanes.next_q == gen_lanes.group_q + GroupWidth'(1));
      assert (gen_lanes.group_q == given_q + GroupWidth'(valid_o) + GroupWidth'(complete));
      assert (ended_q <= (At + 1)'(1 << At) && found_q == ({1'b0, followed} < ended_q));
      // rows: from the first that is not through on
      if (gen_lanes.b_valid_q) assert (gen_lanes.a_valid_q);
      if (gen_lanes.a_valid_q) assert (in_order(gen_lanes.a_ends_q, gone_q) && a_end > {gen_lanes.group_q, {LogLanes{1'b0}}});
      if (gen_lanes.b_valid_q) assert (in_order(gen_lanes.b_ends_q, a_end));
      assert (ended_q == (gen_lanes.b_valid_q ? b_end : gen_lanes.a_valid_q ? a_end : gone_q));
      assert (gen_lanes.a_valid_q ? gone_q[At:LogLanes] <= gen_lanes.group_q : gone_q[At:LogLanes] == gen_lanes.group_q);
      // the child that is followed, in the rows, behind them, and among the parents
      if (gen_lanes.a_valid_q && gone_q <= {1'b0, followed} && {1'b0, followed} < a_end)
        assert (wanted_q == {gen_lanes.a_row_q, first_above(gen_lanes.a_ends_q)});
      if (gen_lanes.b_valid_q && a_end <= {1'b0, followed} && {1'b0, followed} < b_end)
        assert (wanted_q == {gen_lanes.b_row_q, first_above(gen_lanes.b_ends_q)});
      if (gen_lanes.looked_q) assert ((gen_lanes.before_q & ~gen_lanes.known_q) == '0);
      if (complete) assert (&gen_lanes.known_q);
      if (gen_lanes.before_q != '0) assert (!valid_o);
      if (behind == group && gen_lanes.before_q[lane]) assert (found_q && parent == wanted_q);
      if (behind == group && gen_lanes.looked_q && gen_lanes.known_q[lane])
        assert (found_q && (gen_lanes.before_q[lane] || wanted == wanted_q));
    end
  end
  for (genvar l = 0; l < Lanes; l++) begin : gen_so_far
    count_t child;
    assign child = {gen_lanes.group_q, LogLanes'(l)};
    always_comb begin
      if (rst_ni && cleared_q && child < gone_q) assert (so_far[l]);
      if (rst_ni && cleared_q && so_far[l]) assert (child < ended_q);
    end
  end
