// Parents for Lanes children a cycle, from rows of particles and the children that they end with (mote_offspring).
//
//   parent of child c: the first particle i with J_i > c;   children come in groups of Lanes, lane l has child Lanes k + l
//
// Several lanes look at two rows; a group whose children lie in more waits with those it has. One lane looks at one.
//
// range    J do not decrease, rows have children, the last J is the number of all children, a multiple of Lanes
// timing   a group shows 2 cycles after the row that completes it; a group a cycle unless it lies in three rows or more
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
    localparam int unsigned PlaceWidth = $clog2(Many);
    logic [RowWidth-1:0] a_row_q, b_row_q;
    logic [EndsWidth-1:0] a_ends_q, b_ends_q;
    logic a_valid_q, b_valid_q;

    // ---- the children so far, and those of the group that the rows tell
    count_t first_q, known_q, group_end, end_known, a_end, b_end;
    assign a_end = a_ends_q[EndsWidth-1-:At+1];
    assign b_end = b_ends_q[EndsWidth-1-:At+1];
    logic done, moves, a_through, b_through;
    assign group_end = first_q + (At + 1)'(Lanes);
    assign end_known = b_valid_q ? b_end : a_end;
    assign done = a_valid_q && end_known >= group_end;
    assign moves = a_valid_q && !(done && valid_o && !ready_i);
    assign a_through = moves && (!done || a_end <= group_end);
    assign b_through = moves && (!done || b_end <= group_end);

    logic [Lanes*At-1:0] kept_q, group;
    for (genvar l = 0; l < Lanes; l++) begin : gen_child
      count_t child;
      logic in_a;
      logic [EndsWidth-1:0] ends;
      logic [PlaceWidth-1:0] place;
      assign child = first_q + (At + 1)'(l);
      assign in_a = a_end > child;
      assign ends = in_a ? a_ends_q : b_ends_q;
      always_comb begin
        place = '0;
        for (int i = Many - 1; i >= 0; i--) if (ends[i*(At+1)+:At+1] > child) place = PlaceWidth'(i);
      end
      assign group[l*At+:At] = child < known_q ? kept_q[l*At+:At] : {in_a ? a_row_q : b_row_q, place};
    end
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) valid_o <= 1'b0;
      else if (clear_i) valid_o <= 1'b0;
      else if (moves && done) valid_o <= 1'b1;
      else if (ready_i) valid_o <= 1'b0;
    end
    always_ff @(posedge clk_i) begin
      if (moves && done) parent_o <= group;
      if (moves) kept_q <= group;
      if (clear_i) begin
        first_q <= '0;
        known_q <= '0;
      end else if (moves) begin
        if (done) first_q <= group_end;
        known_q <= done ? group_end : end_known;
      end
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
