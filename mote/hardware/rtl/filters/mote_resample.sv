// The parents of a step's children beside the next step's propagation, Lanes children a cycle.
//
//   Scheme  0 systematic: children by mote_offspring, their parents by mote_children
//           1 residual-systematic, one lane: mote_residual_systematic    2 roulette, one lane: mote_roulette
//   uniform numbers of 24 bits: a word a step, for roulette a word a child
//
// formats  weights and their scales: mote_weight's, short_i for schemes 0 and 1; parent_o: lane l has child Lanes k + l
// range    as mote_offspring; a run's first weight comes after starts_i. Schemes 1 and 2 draw no children unless more_i says,
//          a cycle after last_i, that a step follows
// timing   the first parents are there 10 + 3 Product + 2 log2 Lanes cycles (several lanes: one more) after last_i, or when the first row with
//          children is reached, by other schemes later; total_i stands 1 + log2 Lanes cycles after last_i
// golden   mote/hardware/filters/resampler.hpp
module mote_resample #(
    parameter int unsigned Lanes      = 1,
    parameter int unsigned Scheme     = 0,
    parameter int unsigned At         = 10,
    parameter int unsigned Width      = 24,
    parameter int unsigned ScaleWidth = 12,
    parameter logic [63:0] Seed       = 64'd1,
    parameter int unsigned Stream     = 0,
    parameter int unsigned Product    = 1,
    localparam int unsigned SumWidth  = Width + At
) (
    input  logic                         clk_i,
    input  logic                         rst_ni,
    input  logic                         starts_i,  // a run
    input  logic        [At:0]           n_i,       // of a lane
    // weights, slot after slot
    input  logic                         write_i,
    input  logic                         last_i,
    input  logic        [1:0]            rise_i,
    input  logic [Lanes*Width-1:0]       weight_i,
    input  logic [Lanes*18-1:0]          short_i,
    input  logic signed [ScaleWidth-1:0] scale_i,
    input  logic        [SumWidth-1:0]   total_i,
    input  logic                         more_i,    // a step follows
    // parents
    output logic                         valid_o,
    input  logic                         ready_i,
    output logic [Lanes*At-1:0]          parent_o
);
  logic [31:0] word;
  logic total_valid, draws;
  mote_valid #(.Depth(1 + $clog2(Lanes))) u_total_valid (.clk_i, .rst_ni, .valid_i(last_i), .valid_o(total_valid));
  mote_words #(.Seed(Seed), .Stream(Stream)) u_words (.clk_i, .rst_ni, .advance_i(draws), .word_o(word));
  logic unused_word;
  assign unused_word = ^word[7:0];

  if (Scheme == 0) begin : gen_systematic
    localparam int unsigned RowWidth = At - $clog2(2 * Lanes);
    logic row_valid, row_pop, unused_more, unused_weight;
    logic [RowWidth-1:0] row;
    logic [2*Lanes*(At+1)-1:0] ends;
    assign draws = total_valid;
    assign unused_more = more_i;
    assign unused_weight = ^{weight_i, scale_i[ScaleWidth-1:3]};

    // Rows under way when a run ends come in until the next one's first weight.
    logic drops, drops_q;
    assign drops = starts_i || drops_q && !write_i;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) drops_q <= 1'b0;
      else drops_q <= drops;
    end
    mote_offspring #(.Lanes(Lanes), .At(At), .Width(Width), .Product(Product)) u_offspring (
        .clk_i, .rst_ni,
        .drop_i(drops),
        .n_i,
        .write_i,
        .last_i,
        .short_i,
        .rise_i,
        .scale_i(scale_i[2:0]),
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
  end else if (Scheme == 1) begin : gen_residual
    logic unused_starts, unused_weight;
    assign unused_starts = starts_i;
    assign unused_weight = ^{weight_i, scale_i[ScaleWidth-1:3]};
    assign draws = total_valid;
    mote_residual_systematic #(.At(At), .Width(Width), .Product(Product)) u_residual (
        .clk_i, .rst_ni, .n_i, .write_i, .last_i, .short_i, .rise_i, .scale_i(scale_i[2:0]), .total_valid_i(total_valid), .total_i,
        .uniform_i(word[31:8]), .more_i, .valid_o, .ready_i, .parent_o);
  end else begin : gen_roulette
    logic unused_starts, unused_short;
    assign unused_starts = starts_i;
    assign unused_short = ^{short_i, rise_i};
    mote_roulette #(.At(At), .Width(Width), .ScaleWidth(ScaleWidth), .Product(Product)) u_roulette (
        .clk_i, .rst_ni, .n_i, .write_i, .last_i, .weight_i, .scale_i, .total_valid_i(total_valid), .total_i, .more_i,
        .draw_o(draws), .uniform_i(word[31:8]), .valid_o, .ready_i, .parent_o);
  end
endmodule
