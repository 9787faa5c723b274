// The sum of a row of words, or the greatest of them, by a tree with a register behind each level.
//
//   row_o = sum_l word_i[l]   or with Greatest   row_o = max_l word_i[l]
//
// formats  words: signed or not, Width bits; row_o: RowWidth bits, as signed as the words
// range    RowWidth >= Width + log2 Lanes (Greatest: Width): nothing overflows
// timing   latency log2 Lanes (one word: a wire), initiation interval 1
// golden   the sum of C++'s integers, std::max_element
module mote_row #(
    parameter int unsigned Lanes    = 4,
    parameter int unsigned Width    = 24,
    parameter int unsigned RowWidth = 34,
    parameter bit Signed            = 1'b0,
    parameter bit Greatest          = 1'b0
) (
    input  logic                   clk_i,
    input  logic [Lanes*Width-1:0] word_i,
    output logic [RowWidth-1:0]    row_o
);
  function automatic logic signed [RowWidth:0] extended(input logic [Width-1:0] word);
    extended = (RowWidth + 1)'($signed({Signed && word[Width-1], word}));
  endfunction
  function automatic logic [RowWidth-1:0] of_two(input logic [Width-1:0] a, input logic [Width-1:0] b);
    of_two = RowWidth'(!Greatest ? extended(a) + extended(b) : extended(a) > extended(b) ? extended(a) : extended(b));
  endfunction
  if (Lanes == 1) begin : gen_word
    logic unused_clk;
    assign unused_clk = clk_i;
    assign row_o = RowWidth'(extended(word_i));
  end else begin : gen_tree
    localparam int unsigned Half = Lanes / 2;
    logic [Half*RowWidth-1:0] pairs_q;
    for (genvar l = 0; l < Half; l++) begin : gen_pair
      always_ff @(posedge clk_i)
        pairs_q[l*RowWidth+:RowWidth] <= of_two(word_i[2*l*Width+:Width], word_i[(2*l+1)*Width+:Width]);
    end
    mote_row #(.Lanes(Half), .Width(RowWidth), .RowWidth(RowWidth), .Signed(Signed), .Greatest(Greatest)) u_rest (
        .clk_i, .word_i(pairs_q), .row_o);
  end
endmodule
