// A level of a search through sums that do not decrease: a memory of the sums at the middles of what the levels above left.
//
//   numbers m = 1 .. n - 1 stand for the sums of m weights; this level holds the odd multiples of 2^Bit
//   place_o = place_i + 2^Bit if that is below n_i and its sum <= threshold_i, else place_i
//
// Sums are stored with the scale that they were made at and lowered to last_scale_i when they are read, to nothing from three
// quanta on.
//
// formats  sums and thresholds: unsigned, SumWidth bits; places: multiples of 2^(Bit + 1) that are below 2^At
// timing   latency 4, initiation interval 1; what is written can be read two cycles later; two banks
// golden   mote/hardware/filters/roulette.hpp
module mote_search_level #(
    parameter int unsigned At         = 10,
    parameter int unsigned Bit        = 0,
    parameter int unsigned SumWidth   = 34,
    parameter int unsigned ScaleWidth = 12
) (
    input  logic                         clk_i,
    input  logic        [At:0]           n_i,
    // sums, number after number
    input  logic                         write_i,
    input  logic                         write_bank_i,
    input  logic        [At-1:0]         number_i,
    input  logic        [SumWidth-1:0]   sum_i,
    input  logic signed [ScaleWidth-1:0] scale_i,
    // the search
    input  logic                         read_bank_i,
    input  logic signed [ScaleWidth-1:0] last_scale_i,
    input  logic        [At-1:0]         place_i,
    input  logic        [SumWidth-1:0]   threshold_i,
    output logic        [At-1:0]         place_o,
    output logic        [SumWidth-1:0]   threshold_o
);
  localparam int unsigned WordWidth = SumWidth + ScaleWidth;
  localparam int unsigned Words = 2 << (At - 1 - Bit);
  localparam logic [At-1:0] Step = At'(1) << Bit;

  // ---- memory, as large as the level: look-up tables near the root, blocks near the leaves
  logic [WordWidth-1:0] memory[Words];
  logic [WordWidth-1:0] read_q, word_q;
  logic holds;
  assign holds = write_i && number_i[Bit:0] == (Bit + 1)'(1) << Bit;
  always_ff @(posedge clk_i) begin
    if (holds) memory[(At-Bit)'({write_bank_i, number_i} >> (Bit + 1))] <= {scale_i, sum_i};
    read_q <= memory[(At-Bit)'({read_bank_i, place_i} >> (Bit + 1))];
    word_q <= read_q;
  end

  // ---- the sum at the last scale, and the threshold beside it
  logic [ScaleWidth-1:0] by;
  logic [SumWidth-1:0] sum_q, threshold3;
  logic [At-1:0] place2, place_q;
  logic below_q;
  assign by = last_scale_i - $signed(word_q[WordWidth-1:SumWidth]);
  mote_delay #(.Width(At), .Depth(2)) u_place (.clk_i, .d_i(place_i), .d_o(place2));
  mote_delay #(.Width(SumWidth), .Depth(3)) u_threshold (.clk_i, .d_i(threshold_i), .d_o(threshold3));
  always_ff @(posedge clk_i) begin
    sum_q   <= by > ScaleWidth'(2) ? '0 : word_q[SumWidth-1:0] >> {by[1:0], 3'b0};
    place_q <= place2;
    below_q <= {1'b0, place2 | Step} < n_i;
    place_o     <= below_q && sum_q <= threshold3 ? place_q | Step : place_q;
    threshold_o <= threshold3;
  end
endmodule
