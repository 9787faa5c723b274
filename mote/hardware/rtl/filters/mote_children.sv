// Parents for Lanes children a cycle, from rows of particles and the children that they end with (mote_offspring).
//
//   parent of child c: the first particle i with J_i > c;   children come in groups of Lanes, lane l has child Lanes k + l
//
// Several lanes look at two rows; a group whose children lie in more waits with those it has. One lane looks at one.
//
// range    J do not decrease, rows have children, the last J is the number of all children, a multiple of Lanes
// timing   a group shows 2 cycles (several lanes: 3) after the row that completes it; a group a cycle unless it lies in three rows or more
// golden   mote/hardware/filters/offspring.hpp
module mote_children #(
    parameter int unsigned Lanes     = 1,
    parameter int unsigned At        = 10,
    localparam int unsigned Many     = 2 * Lanes,
    localparam int unsigned RowWidth = At - $clog2(Many)
) (
    input  logic                     clk_i,
    input  logic                     rst_ni,
    input  logic                     clear_i,
    // rows
    input  logic                     row_valid_i,
    output logic                     row_pop_o,
    input  logic [RowWidth-1:0]      row_i,
    input  logic [Many*(At+1)-1:0]   ends_i,
    // groups
    output logic                     valid_o,
    input  logic                     ready_i,
    output logic [Lanes*At-1:0]      parent_o
);
  typedef logic [At:0] count_t;
  if (Lanes == 1) begin : gen_lane_alone
    logic [RowWidth-1:0] row_q;
    count_t even_end_q, end_q, child_q, next_q;  // children: the one to find a parent for, the one after it
    logic row_valid_q, moves, through;
    assign moves = row_valid_q && (!valid_o || ready_i);
    assign through = moves && end_q == next_q;
    assign row_pop_o = row_valid_i && (!row_valid_q || through);
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) {row_valid_q, valid_o} <= '0;
      else if (clear_i) {row_valid_q, valid_o} <= '0;
      else begin
        row_valid_q <= row_pop_o || row_valid_q && !through;
        valid_o     <= row_valid_q || valid_o && !ready_i;
      end
    end
    always_ff @(posedge clk_i) begin
      if (row_pop_o) {row_q, end_q, even_end_q} <= {row_i, ends_i};
      if (moves) parent_o <= {row_q, even_end_q <= child_q};
      if (clear_i) begin
        child_q <= '0;
        next_q  <= (At + 1)'(1);
      end else if (moves) begin
        child_q <= next_q;
        next_q  <= next_q + (At + 1)'(1);
      end
    end
  end else begin : gen_lanes
    localparam int unsigned EndsWidth = Many * (At + 1);
    localparam int unsigned PlaceWidth = $clog2(2 * Many);  // of a particle of both rows
    localparam int unsigned LaneBits = $clog2(Lanes);
    typedef logic [At-LaneBits:0] group_t;
    logic [RowWidth-1:0] a_row_q, b_row_q;
    logic [EndsWidth-1:0] a_ends_q, b_ends_q;
    logic a_valid_q, b_valid_q;

    // ---- which children of the group come before each end: an end is a group and a child in it
    group_t group_q, next_q;
    logic [2*Many-1:0] later;        // ends of groups behind
    logic [2*Many*Lanes-1:0] above;  // ends, child after child
    logic [Lanes-1:0] known;         // children whose parents the rows tell
    logic goes, moves, a_through, b_through;
    for (genvar i = 0; i < 2 * Many; i++) begin : gen_end
      count_t particle_end;
      logic here;
      logic [Lanes-1:0] children;
      assign particle_end = i < Many ? a_ends_q[i%Many*(At+1)+:At+1] : b_ends_q[i%Many*(At+1)+:At+1];
      assign later[i] = particle_end[At:LaneBits] > group_q;
      assign here = particle_end[At:LaneBits] == group_q;
      assign children = {Lanes{later[i]}} | {Lanes{here}} & ((Lanes'(1) << particle_end[LaneBits-1:0]) - Lanes'(1));
      for (genvar l = 0; l < Lanes; l++) begin : gen_child
        assign above[l*2*Many+i] = children[l];
      end
    end
    for (genvar l = 0; l < Lanes; l++) begin : gen_known
      assign known[l] = above[l*2*Many+Many-1] || b_valid_q && above[(l+1)*2*Many-1];
    end
    // A row is through when its last end is the next group's first child or before it.
    count_t next_first;
    assign next_first = {next_q, {LaneBits{1'b0}}};
    assign goes = !valid_o || ready_i;
    assign moves = a_valid_q && goes;
    assign a_through = moves && (!later[Many-1] || a_ends_q[EndsWidth-1-:At+1] == next_first);
    assign b_through = moves && (!later[2*Many-1] || b_ends_q[EndsWidth-1-:At+1] == next_first);
    always_ff @(posedge clk_i) begin
      if (clear_i) begin
        group_q <= '0;
        next_q  <= (At - LaneBits + 1)'(1);
      end else if (moves && known[Lanes-1]) begin
        group_q <= next_q;
        next_q  <= next_q + (At - LaneBits + 1)'(1);
      end
    end

    // ---- the parents of those that were not known before: the first end above each
    logic [2*Many*Lanes-1:0] above_q;
    logic [RowWidth-1:0] a_looked_q, b_looked_q;
    logic [Lanes-1:0] known_q, before_q;  // by the rows looked at, and by those before them
    logic looked_q;
    function automatic logic [PlaceWidth-1:0] first_of(input logic [2*Many-1:0] ends_above);
      first_of = '0;
      for (int k = PlaceWidth - 1; k >= 0; k--)
        if (!ends_above[first_of|PlaceWidth'((1<<k)-1)]) first_of[k] = 1'b1;
    endfunction
    for (genvar l = 0; l < Lanes; l++) begin : gen_parent
      logic [PlaceWidth-1:0] place;
      assign place = first_of(above_q[l*2*Many+:2*Many]);
      always_ff @(posedge clk_i)
        if (goes && !before_q[l])
          parent_o[l*At+:At] <= {place[PlaceWidth-1] ? b_looked_q : a_looked_q, place[PlaceWidth-2:0]};
    end
    always_ff @(posedge clk_i) begin
      if (goes) {above_q, a_looked_q, b_looked_q, known_q} <= {above, a_row_q, b_row_q, known};
      if (clear_i) before_q <= '0;
      else if (goes && looked_q) before_q <= known_q[Lanes-1] ? '0 : known_q;
    end
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) {looked_q, valid_o} <= '0;
      else if (clear_i) {looked_q, valid_o} <= '0;
      else if (goes) {looked_q, valid_o} <= {a_valid_q, looked_q && known_q[Lanes-1]};
    end

    // ---- the rows move up
    logic a_stays, b_stays;
    assign a_stays = a_valid_q && !a_through;
    assign b_stays = b_valid_q && !b_through;
    assign row_pop_o = row_valid_i && !(a_stays && b_stays);
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) {a_valid_q, b_valid_q} <= '0;
      else if (clear_i) {a_valid_q, b_valid_q} <= '0;
      else begin
        a_valid_q <= a_stays || b_stays || row_pop_o;
        b_valid_q <= a_stays && b_stays || (a_stays || b_stays) && row_pop_o;
      end
    end
    always_ff @(posedge clk_i) begin
      if (!a_stays) {a_row_q, a_ends_q} <= b_stays ? {b_row_q, b_ends_q} : {row_i, ends_i};
      if (!(a_stays && b_stays)) {b_row_q, b_ends_q} <= {row_i, ends_i};
    end
  end
endmodule
