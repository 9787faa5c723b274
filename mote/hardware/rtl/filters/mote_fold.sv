// A chain of independent Metropolis-Hastings that decides on a row of Lanes proposals a cycle, as if they came one by one.
//
//   for l = 0 .. Lanes - 1:   accepts_o[l]  =  (first_i and l = 0)  or  lw <= b_l,   b_l = lw_l - log2 u_l;   where it accepts lw <- lw_l
//
// Of a row the chain's weight decides the first proposal that is accepted alone: the first l with lw <= b_l. Which ones follow
// that, comparisons of lw_i with b_j tell (i < j), which are made before the chain is there:
//
//   last[i][j] = what the chain stands at after proposal j if it accepted i <= j:   last[i][i] = i,
//   last[i][j] = lw_last[i][j-1] <= b_j ? j : last[i][j-1]
//
// formats  log weights: signed, octaves, 10 fraction bits; a lane's words from stream Stream + StreamStep l
// timing   word_i, then log_weight_i, valid_i and first_i 5 cycles later, state_i Lanes + 2 cycles after that; accepts_o and
//          state_o, the chain's states after each proposal, in the same cycle. Initiation interval 1: of the chain itself a
//          comparison and the choice of a weight
// golden   mote/hardware/filters/imh.hpp
// source   IMH-HW (16) - (17); IMH-OPT fig. 2
module mote_fold #(
    parameter int unsigned Lanes      = 2,
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
  localparam int unsigned Index = Lanes > 1 ? $clog2(Lanes) : 1;
  localparam int unsigned Table = Lanes * Lanes * Index;  // last[i][j] at (i Lanes + j) Index

  // ---- 1: bounds
  logic [Lanes*LogWidth-1:0] log_q;
  logic [Lanes*Bound-1:0] bound_q;
  for (genvar l = 0; l < Lanes; l++) begin : gen_bound
    logic [31:0] word;
    logic [15:0] drop;
    logic signed [LogWidth-1:0] log_weight;
    mote_words #(.Seed(Seed), .Stream(Stream + StreamStep * l)) u_words (
        .clk_i, .rst_ni, .advance_i(word_i), .word_o(word));
    mote_log_uniform #(.Table(Log2Table)) u_log_uniform (.clk_i, .word_i(word), .drop_o(drop));
    assign log_weight = log_weight_i[l*LogWidth+:LogWidth];
    always_ff @(posedge clk_i) bound_q[l*Bound+:Bound] <= Bound'(log_weight) + Bound'({1'b0, drop});
  end
  always_ff @(posedge clk_i) log_q <= log_weight_i;

  // ---- 2: which proposal another one would be followed by; 3 .. Lanes: the table, a column a cycle
  logic [Lanes*Lanes-1:0] follows;  // [i][j]: lw_i <= b_j
  always_comb begin
    follows = '0;
    for (int i = 0; i < Lanes; i++)
      for (int j = i + 1; j < Lanes; j++)
        follows[i*Lanes+j] = Bound'($signed(log_q[i*LogWidth+:LogWidth])) <= $signed(bound_q[j*Bound+:Bound]);
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

  // ---- Lanes + 1: the chain's weight, by what it is after a row that begins with i
  logic [Lanes*LogWidth-1:0] log_whole, log_after_q;
  logic [Lanes*Bound-1:0] bound;
  logic valid, first;
  mote_delay #(.Width(Lanes * LogWidth), .Depth(Lanes - 1)) u_log (.clk_i, .d_i(log_q), .d_o(log_whole));
  mote_delay #(.Width(Lanes * Bound), .Depth(Lanes)) u_bound (.clk_i, .d_i(bound_q), .d_o(bound));
  mote_delay #(.Width(1), .Depth(Lanes + 1)) u_first (.clk_i, .d_i(first_i), .d_o(first));
  mote_valid #(.Depth(Lanes + 1)) u_valid (.clk_i, .rst_ni, .valid_i, .valid_o(valid));
  always_ff @(posedge clk_i)
    for (int i = 0; i < Lanes; i++)
      log_after_q[i*LogWidth+:LogWidth] <=
          log_whole[32'(whole[(i*Lanes+Lanes-1)*Index+:Index])*LogWidth+:LogWidth];
  logic signed [LogWidth-1:0] current_log_q;
  logic [Index-1:0] from, from_q;
  logic moves, moves_q, valid_q, first_q;
  always_comb begin
    moves = 1'b0;
    from = '0;
    for (int l = Lanes - 1; l >= 0; l--)
      if ((first && l == 0) || Bound'(current_log_q) <= $signed(bound[l*Bound+:Bound])) begin
        moves = 1'b1;
        from  = Index'(l);
      end
  end
  always_ff @(posedge clk_i) begin
    if (valid && moves) current_log_q <= log_after_q[32'(from)*LogWidth+:LogWidth];
    from_q  <= from;
    moves_q <= moves;
    valid_q <= valid;
    first_q <= first;
  end

  // ---- Lanes + 2: the chain's states
  logic [Table-1:0] standing;
  logic [StateWidth-1:0] current_q;
  mote_delay #(.Width(Table), .Depth(2)) u_standing (.clk_i, .d_i(whole), .d_o(standing));
  for (genvar l = 0; l < Lanes; l++) begin : gen_state
    logic moved;
    logic [Index-1:0] at;
    assign moved = moves_q && {1'b0, from_q} < (Index + 1)'(l + 1);
    assign at = standing[(32'(from_q)*Lanes+l)*Index+:Index];
    assign accepts_o[l] = moved && at == Index'(l) && !(first_q && l == 0);
    assign state_o[l*StateWidth+:StateWidth] = moved ? state_i[32'(at)*StateWidth+:StateWidth] : current_q;
  end
  always_ff @(posedge clk_i) if (valid_q) current_q <= state_o[(Lanes-1)*StateWidth+:StateWidth];
endmodule
