// The parents of a step's children: systematic resampling beside the next step's propagation, Lanes children a cycle.
//
//   v ~ U[0, 1) of 24 bits, a word a step; children by mote_offspring, their parents by mote_children
//
// formats  weights: unsigned, with the scale that they were made at; parent_o: lane l has child Lanes k + l
// range    as mote_offspring; a run's first weight comes after starts_i
// timing   the first parents are there 13 + log2 Lanes cycles (with 8 lanes one more) after last_i, or when the first row with
//          children is reached; total_i stands 1 + log2 Lanes cycles after last_i
// golden   mote/hardware/filters/offspring.hpp
module mote_resample #(
    parameter int unsigned Lanes      = 1,
    parameter int unsigned At         = 10,
    parameter int unsigned Width      = 24,
    parameter int unsigned ScaleWidth = 12,
    parameter logic [63:0] Seed       = 64'd1,
    parameter int unsigned Stream     = 0,
    localparam int unsigned SumWidth  = Width + At
) (
    input  logic                         clk_i,
    input  logic                         rst_ni,
    input  logic                         starts_i,  // a run
    input  logic        [At:0]           n_i,       // of a lane
    // weights, slot after slot
    input  logic                         write_i,
    input  logic                         last_i,
    input  logic [Lanes*Width-1:0]       weight_i,
    input  logic signed [ScaleWidth-1:0] scale_i,
    input  logic        [SumWidth-1:0]   total_i,
    // parents
    output logic                         valid_o,
    input  logic                         ready_i,
    output logic [Lanes*At-1:0]          parent_o
);
  localparam int unsigned RowWidth = At - $clog2(2 * Lanes);
  logic [31:0] word;
  logic total_valid, row_valid, row_pop;
  logic [RowWidth-1:0] row;
  logic [2*Lanes*(At+1)-1:0] ends;
  mote_valid #(.Depth(1 + $clog2(Lanes))) u_total_valid (.clk_i, .rst_ni, .valid_i(last_i), .valid_o(total_valid));
  mote_words #(.Seed(Seed), .Stream(Stream)) u_words (.clk_i, .rst_ni, .advance_i(total_valid), .word_o(word));
  logic unused_word;
  assign unused_word = ^word[7:0];

  // Rows under way when a run ends come in until the next one's first weight.
  logic drops, drops_q;
  assign drops = starts_i || drops_q && !write_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) drops_q <= 1'b0;
    else drops_q <= drops;
  end
  mote_offspring #(.Lanes(Lanes), .At(At), .Width(Width), .ScaleWidth(ScaleWidth)) u_offspring (
      .clk_i, .rst_ni,
      .drop_i(drops),
      .n_i,
      .write_i,
      .last_i,
      .weight_i,
      .scale_i,
      .total_valid_i(total_valid),
      .total_i,
      .uniform_i(word[31:8]),
      .valid_o(row_valid),
      .pop_i(row_pop),
      .row_o(row),
      .ends_o(ends));
  mote_children #(.Lanes(Lanes), .At(At)) u_children (
      .clk_i, .rst_ni,
      .clear_i(drops || last_i),
      .row_valid_i(row_valid),
      .row_pop_o(row_pop),
      .row_i(row),
      .ends_i(ends),
      .valid_o,
      .ready_i,
      .parent_o);
endmodule
