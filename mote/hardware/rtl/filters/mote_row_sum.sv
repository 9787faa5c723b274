// The sum of a row of words, by a tree with a register behind each level.
//
//   sum_o = sum_l word_i[l]
//
// formats  words: signed or not, Width bits; sum_o: SumWidth bits, as signed as the words
// range    SumWidth >= Width + log2 Lanes: nothing overflows
// timing   latency log2 Lanes (one word: a wire), initiation interval 1
// golden   the sum of C++'s integers
module mote_row_sum #(
    parameter int unsigned Lanes    = 4,
    parameter int unsigned Width    = 24,
    parameter int unsigned SumWidth = 34,
    parameter bit Signed            = 1'b0
) (
    input  logic                   clk_i,
    input  logic [Lanes*Width-1:0] word_i,
    output logic [SumWidth-1:0]    sum_o
);
  function automatic logic [SumWidth-1:0] extended(input logic [Width-1:0] word);
    extended = Signed ? SumWidth'($signed(word)) : SumWidth'(word);
  endfunction
  if (Lanes == 1) begin : gen_word
    logic unused_clk;
    assign unused_clk = clk_i;
    assign sum_o = extended(word_i);
  end else begin : gen_tree
    localparam int unsigned Half = Lanes / 2;
    logic [Half*SumWidth-1:0] pairs_q;
    for (genvar l = 0; l < Half; l++) begin : gen_pair
      always_ff @(posedge clk_i)
        pairs_q[l*SumWidth+:SumWidth] <= extended(word_i[2*l*Width+:Width]) + extended(word_i[(2*l+1)*Width+:Width]);
    end
    mote_row_sum #(.Lanes(Half), .Width(SumWidth), .SumWidth(SumWidth), .Signed(Signed)) u_rest (
        .clk_i, .word_i(pairs_q), .sum_o);
  end
endmodule
