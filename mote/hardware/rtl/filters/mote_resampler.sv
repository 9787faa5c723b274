// The parents of a step's children by one of the schemes, beside the next step's propagation.
//
//   Scheme  0 systematic (mote_systematic), 1 residual-systematic (mote_residual_systematic), 2 roulette (mote_roulette)
//
// draw_o takes a uniform word: systematic and residual-systematic one a step, roulette one a child.
//
// range    1 <= n_i <= 2^At; At >= 2, residual-systematic At >= 6
// timing   scale_known_i with last_scale_i at most 3 cycles before the last weight, total_valid_i a cycle after it; parents
//          as the scheme finds them
// golden   mote/hardware/filters/resampler.hpp
module mote_resampler #(
    parameter int unsigned Scheme     = 0,
    parameter int unsigned At         = 10,
    parameter int unsigned Width      = 24,
    parameter int unsigned ScaleWidth = 12,
    localparam int unsigned SumWidth  = Width + At
) (
    input  logic                         clk_i,
    input  logic                         rst_ni,
    input  logic                         drop_i,  // what a run left, before another
    input  logic        [At:0]           n_i,
    // weights, slot after slot
    input  logic                         write_i,
    input  logic        [Width-1:0]      weight_i,
    input  logic signed [ScaleWidth-1:0] scale_i,
    // the end of a step
    input  logic                         scale_known_i,
    input  logic signed [ScaleWidth-1:0] last_scale_i,
    input  logic                         total_valid_i,
    input  logic        [SumWidth-1:0]   total_i,
    input  logic                         more_i,  // a step follows
    // uniform words
    output logic                         draw_o,
    input  logic        [31:0]           word_i,
    // parents, child after child
    output logic                         valid_o,
    input  logic                         ready_i,
    output logic        [At-1:0]         parent_o
);
  logic unused_word;
  assign unused_word = ^word_i[7:0];
  if (Scheme == 0) begin : gen_systematic
    logic unused_more;
    assign unused_more = more_i;
    assign draw_o = total_valid_i;
    mote_systematic #(.At(At), .Width(Width), .ScaleWidth(ScaleWidth)) u_systematic (
        .clk_i, .rst_ni, .drop_i, .n_i, .write_i, .weight_i, .scale_i, .scale_known_i, .last_scale_i,
        .total_valid_i, .total_i, .uniform_i(word_i[31:8]), .valid_o, .ready_i, .parent_o);
  end else begin : gen_by_total
    logic unused_early;
    assign unused_early = ^{drop_i, scale_known_i, last_scale_i};
    if (Scheme == 1) begin : gen_residual
      assign draw_o = total_valid_i;
      mote_residual_systematic #(.At(At), .Width(Width), .ScaleWidth(ScaleWidth)) u_residual (
          .clk_i, .rst_ni, .n_i, .write_i, .weight_i, .scale_i, .total_valid_i, .total_i,
          .uniform_i(word_i[31:8]), .more_i, .valid_o, .ready_i, .parent_o);
    end else begin : gen_roulette
      mote_roulette #(.At(At), .Width(Width), .ScaleWidth(ScaleWidth)) u_roulette (
          .clk_i, .rst_ni, .n_i, .write_i, .weight_i, .scale_i, .total_valid_i, .total_i, .more_i,
          .draw_o, .uniform_i(word_i[31:8]), .valid_o, .ready_i, .parent_o);
    end
  end
endmodule
