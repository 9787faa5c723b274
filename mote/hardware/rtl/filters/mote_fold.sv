// A chain of independent Metropolis-Hastings that decides on a row of Lanes proposals a cycle, as if they came one by one.
//
//   for l = 0 .. Lanes - 1:   accepts_o[l]  =  (first_i and l = 0)  or  lw <= b_l,   b_l = lw_l - log2 u_l;   where it accepts lw <- lw_l
//
// Of a row the chain's weight decides the first proposal that is accepted alone, where the chain enters the row: the first l with
// lw <= b_l. Which ones follow that, comparisons of lw_i with b_j tell (i < j), which are made before the chain is there:
//
//   last[i][j] = what the chain stands at after proposal j if it accepted i <= j:   last[i][i] = i,
//   last[i][j] = lw_last[i][j-1] <= b_j ? j : last[i][j-1]
//
// Where it enters the next row, of bounds b'_l, is compared for every entry into this one, before that is known, and for none
// of them while it is decided:
//
//   entry' = the first l with lw_last[entry][Lanes-1] <= b'_l;    without an entry the first with lw <= b'_l
//
// formats  log weights: signed, octaves, 10 fraction bits; a lane's words from stream Stream + StreamStep l
// timing   word_i, then log_weight_i, valid_i and first_i 5 cycles later, state_i Lanes + 2 cycles after that; accepts_o and
//          state_o, the chain's states after each proposal, in the same cycle. Initiation interval 1: of the chain itself a
//          comparison and the choice of an entry; its weight has another cycle. The first proposal's bound is the greatest
//          there is
// golden   mote/hardware/filters/imh.hpp
// source   IMH-HW (16) - (17); IMH-OPT fig. 2
module mote_fold #(
    parameter int unsigned Lanes      = 2,  // at least 2
    parameter int unsigned LogWidth   = 24,
    parameter int unsigned StateWidth = 18,
    parameter logic [63:0] Seed       = 64'd1,
    parameter int unsigned Stream     = 1,
    parameter int unsigned StreamStep = 1,
    parameter Log2Table               = "log2.hex"
) (
    input  logic                        clk_i,
    input  logic                        rst_ni,
    input  logic                        word_i,
    input  logic                        valid_i,
    input  logic                        first_i,
    input  logic [Lanes*LogWidth-1:0]   log_weight_i,
    input  logic [Lanes*StateWidth-1:0] state_i,
    output logic [Lanes-1:0]            accepts_o,
    output logic [Lanes*StateWidth-1:0] state_o
);
  localparam int unsigned Bound = LogWidth + 1;
  localparam int unsigned Index = $clog2(Lanes);
  localparam int unsigned Table = Lanes * Lanes * Index;  // last[i][j] at (i Lanes + j) Index

  // lw <= b is the carry of b - lw, whose sides stand in registers as the sum takes them: with their sign bits turned over, lw as
  // its complement.
  function automatic logic reaches(input logic [LogWidth-1:0] not_log, input logic [Bound-1:0] bound);
    reaches = 1'(({1'b0, bound, 1'b1} + {1'b0, ~not_log[LogWidth-1], not_log, 1'b1}) >> (Bound + 1));
  endfunction
  function automatic logic [Lanes-1:0] first_of(input logic [Lanes-1:0] bits);
    for (int l = 0; l < Lanes; l++) first_of[l] = bits[l];
    for (int l = 0; l < Lanes; l++) for (int i = 0; i < l; i++) if (bits[i]) first_of[l] = 1'b0;
  endfunction

  // ---- 1: bounds
  logic [Lanes*LogWidth-1:0] not_log_q;
  logic [Lanes*Bound-1:0] bound_q;
  for (genvar l = 0; l < Lanes; l++) begin : gen_bound
    logic [31:0] word;
    logic [15:0] drop;
    logic signed [LogWidth-1:0] log_weight;
    logic signed [Bound-1:0] bound;
    mote_words #(.Seed(Seed), .Stream(Stream + StreamStep * l)) u_words (
        .clk_i, .rst_ni, .advance_i(word_i), .word_o(word));
    mote_log_uniform #(.Table(Log2Table)) u_log_uniform (.clk_i, .word_i(word), .drop_o(drop));
    assign log_weight = log_weight_i[l*LogWidth+:LogWidth];
    assign bound = Bound'(log_weight) + Bound'({1'b0, drop});
    always_ff @(posedge clk_i)
      bound_q[l*Bound+:Bound] <= first_i && l == 0 ? '1 : {~bound[LogWidth], bound[LogWidth-1:0]};
  end
  always_ff @(posedge clk_i) not_log_q <= ~log_weight_i;

  // ---- 2: which proposal another one would be followed by; 3 .. Lanes: the table, a column a cycle
  logic [Lanes*Lanes-1:0] follows;  // [i][j]: lw_i <= b_j
  always_comb begin
    follows = '0;
    for (int i = 0; i < Lanes; i++)
      for (int j = i + 1; j < Lanes; j++)
        follows[i*Lanes+j] = reaches(not_log_q[i*LogWidth+:LogWidth], bound_q[j*Bound+:Bound]);
  end
  logic [(Lanes+1)*Table-1:0] last;  // after each cycle
  logic [(Lanes+1)*Lanes*Lanes-1:0] follow;
  logic unused_table;
  assign unused_table = ^{last[Table-1:0], follow, follows};
  assign last[2*Table-1:0] = '0;
  assign follow[0+:2*Lanes*Lanes] = '0;
  for (genvar s = 2; s <= Lanes; s++) begin : gen_column
    logic [Table-1:0] now, next_d, next_q;
    logic [Lanes*Lanes-1:0] follows_now, follows_q;
    assign now = last[(s-1)*Table+:Table];
    assign follows_now = s == 2 ? follows : follow[(s-1)*Lanes*Lanes+:Lanes*Lanes];
    always_comb begin
      next_d = now;
      for (int i = 0; i < s; i++) begin
        if (i == s - 1 || follows_now[32'(now[(i*Lanes+s-2)*Index+:Index])*Lanes+s-1])
          next_d[(i*Lanes+s-1)*Index+:Index] = Index'(s - 1);
        else next_d[(i*Lanes+s-1)*Index+:Index] = now[(i*Lanes+s-2)*Index+:Index];
      end
    end
    always_ff @(posedge clk_i) begin
      next_q    <= next_d;
      follows_q <= follows_now;
    end
    assign last[s*Table+:Table] = next_q;
    assign follow[s*Lanes*Lanes+:Lanes*Lanes] = follows_q;
  end
  logic [Table-1:0] whole;
  assign whole = last[Lanes*Table+:Table];

  // ---- Lanes: the bounds, where there is no row such that nothing is accepted; resets keep registers out of slow shift registers
  // and their inputs out of slow synchronous resets
  logic [Lanes*Bound-1:0] bound, bound_next_q, bound_now_q;
  logic valid, valid_q, first_q;
  mote_delay #(.Width(Lanes * Bound), .Depth(Lanes - 2)) u_bound (.clk_i, .d_i(bound_q), .d_o(bound));
  mote_delay #(.Width(1), .Depth(Lanes + 2)) u_first (.clk_i, .d_i(first_i), .d_o(first_q));
  mote_valid #(.Depth(Lanes - 1)) u_valid (.clk_i, .rst_ni, .valid_i, .valid_o(valid));
  mote_valid #(.Depth(3)) u_valid_q (.clk_i, .rst_ni, .valid_i(valid), .valid_o(valid_q));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {bound_now_q, bound_next_q} <= '0;
    else {bound_now_q, bound_next_q} <= {bound_next_q, valid ? bound : '0};
  end

  // ---- Lanes + 1: the chain's weight after a row that it enters at i; Lanes + 2: where it would enter the next one
  logic [Lanes*LogWidth-1:0] not_log, not_log_after_q, not_log_before_q;
  logic [Lanes*Lanes-1:0] entry_after_d, entry_after_q;  // [i][l]
  mote_delay #(.Width(Lanes * LogWidth), .Depth(Lanes - 1)) u_not_log (.clk_i, .d_i(not_log_q), .d_o(not_log));
  function automatic logic [Lanes-1:0] entry_of(input logic [LogWidth-1:0] not_log_of, input logic [Lanes*Bound-1:0] bounds);
    logic [Lanes-1:0] accepts;
    for (int l = 0; l < Lanes; l++) accepts[l] = reaches(not_log_of, bounds[l*Bound+:Bound]);
    entry_of = first_of(accepts);
  endfunction
  always_comb
    for (int i = 0; i < Lanes; i++)
      entry_after_d[i*Lanes+:Lanes] = entry_of(not_log_after_q[i*LogWidth+:LogWidth], bound_next_q);
  always_ff @(posedge clk_i) begin
    for (int i = 0; i < Lanes; i++)
      not_log_after_q[i*LogWidth+:LogWidth] <=
          not_log[32'(whole[(i*Lanes+Lanes-1)*Index+:Index])*LogWidth+:LogWidth];
    not_log_before_q <= not_log_after_q;
  end

  // ---- Lanes + 2: the entry of a row, beside the chain's weight before it
  logic [Lanes-1:0] entry_d, entry_q;
  logic stays_q;
  logic [LogWidth-1:0] not_current_d, not_current_q;
  always_comb begin
    entry_d = stays_q ? entry_of(not_current_q, bound_now_q) : '0;
    not_current_d = '0;
    for (int i = 0; i < Lanes; i++) begin
      entry_d       |= entry_after_q[i*Lanes+:Lanes] & {Lanes{entry_q[i]}};
      not_current_d |= not_log_before_q[i*LogWidth+:LogWidth] & {LogWidth{entry_q[i]}};
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      entry_after_q <= '0;
      entry_q       <= '0;
      stays_q       <= 1'b1;
      not_current_q <= '0;
    end else begin
      entry_after_q <= entry_after_d;
      entry_q       <= entry_d;
      stays_q       <= entry_d == '0;
      if (!stays_q) not_current_q <= not_current_d;
    end
  end

  // ---- Lanes + 2: the chain's states
  logic [Table-1:0] standing, standing_q;
  logic [StateWidth-1:0] current_q;
  mote_delay #(.Width(Table)) u_standing (.clk_i, .d_i(whole), .d_o(standing));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) standing_q <= '0;
    else standing_q <= standing;
  end
  for (genvar l = 0; l < Lanes; l++) begin : gen_state
    logic moved;
    logic [Index-1:0] at;
    assign moved = |entry_q[l:0];
    always_comb begin
      at = '0;
      for (int i = 0; i <= l; i++) at |= standing_q[(i*Lanes+l)*Index+:Index] & {Index{entry_q[i]}};
    end
    assign accepts_o[l] = moved && at == Index'(l) && !(first_q && l == 0);
    assign state_o[l*StateWidth+:StateWidth] = moved ? state_i[32'(at)*StateWidth+:StateWidth] : current_q;
  end
  always_ff @(posedge clk_i) if (valid_q) current_q <= state_o[(Lanes-1)*StateWidth+:StateWidth];
endmodule
