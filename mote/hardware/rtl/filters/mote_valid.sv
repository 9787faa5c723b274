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
  if (Depth == 0) begin : gen_wire
    logic unused_clock;
    assign unused_clock = clk_i ^ rst_ni;
    assign valid_o = valid_i;
  end else begin : gen_line
    logic [Depth-1:0] line_q;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) line_q <= '0;
      else line_q <= Depth'({line_q, valid_i});
    end
    assign valid_o = line_q[Depth-1];
  end
endmodule
