// The log weight of local_level_propose.sv's states, described there.
module local_level_weigh (
    input  logic               clk_i,
    input  logic signed [17:0] observed_i,
    input  logic signed [17:0] state_i,
    output logic signed [23:0] log_weight_o
);
  logic signed [18:0] error_q;
  logic signed [37:0] square_q;
  logic unused_square;
  assign unused_square = ^square_q[9:0];
  logic signed [39:0] scaled_q;
  always_ff @(posedge clk_i) begin
    error_q      <= 19'(observed_i) - 19'(state_i);
    square_q     <= 38'(error_q) * 38'(error_q);
    scaled_q     <= 40'($signed(square_q[37:10])) * 40'sd3206;
    log_weight_o <= -24'(scaled_q >>> 16);
  end
endmodule
