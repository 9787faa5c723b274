// mote_delay: a word, Depth clocks later.
//
// timing  latency Depth (0: a wire), one word a clock; no reset, so that shift registers in look-up tables can hold it
module mote_delay #(
    parameter int Width = 1,
    parameter int Depth = 1
) (
    input  logic             clk_i,
    input  logic [Width-1:0] d_i,
    output logic [Width-1:0] d_o
);

  if (Depth == 0) begin : gen_wire
    logic unused_clk;
    assign unused_clk = clk_i;
    assign d_o = d_i;
  end else if (Depth == 1) begin : gen_register
    always_ff @(posedge clk_i) d_o <= d_i;
  end else begin : gen_chain
    logic [Depth*Width-1:0] chain_q;
    always_ff @(posedge clk_i) chain_q <= {chain_q[(Depth-1)*Width-1:0], d_i};
    assign d_o = chain_q[Depth*Width-1-:Width];
  end

endmodule
