// A flag, Depth cycles later, cleared by reset.
//
// timing  latency Depth, initiation interval 1; Depth = 0 is a wire
module mote_valid #(
    parameter int unsigned Depth = 1
) (
    input  logic clk_i,
    input  logic rst_ni,
    input  logic valid_i,
    output logic valid_o
);
  logic [Depth:0] line;
  assign line[0] = valid_i;
  assign valid_o = line[Depth];
  for (genvar i = 0; i < Depth; i++) begin : gen_line
    logic valid_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) valid_q <= 1'b0;
      else valid_q <= line[i];
    end
    assign line[i+1] = valid_q;
  end
endmodule
