// The log weight of growth_propose.sv's states, described there.
module growth_weigh (
    input  logic                    clk_i,
    input  logic        [1:0][19:0] observed_i,
    input  logic        [1:0][17:0] state_i,
    output logic signed [23:0]      log_weight_o
);
  logic signed [47:0] part[2];
  for (genvar d = 0; d < 2; d++) begin : gen_part
    logic signed [35:0] square_q;
    logic unused_square;
    assign unused_square = ^square_q[9:0];
    logic signed [41:0] mean_q;
    logic signed [25:0] error_q;
    logic signed [47:0] part_q;
    logic signed [25:0] error;
    assign error = 26'($signed(observed_i[d])) - 26'(mean_q >>> 16);
    always_ff @(posedge clk_i) begin
      square_q <= 36'($signed(state_i[d])) * 36'($signed(state_i[d]));
      mean_q   <= 42'($signed(square_q[35:10])) * 42'sd3277;
      error_q  <= error > 26'sd524287 ? 26'sd524287 : error < -26'sd524287 ? -26'sd524287 : error;
      part_q   <= 48'(error_q) * 48'(error_q);
    end
    assign part[d] = part_q >>> 10;
  end
  logic signed [47:0] scaled;
  assign scaled = ((part[0] + part[1]) * 48'sd47274) >>> 16;
  always_ff @(posedge clk_i) log_weight_o <= scaled > 48'sd8388607 ? -24'sd8388607 : -24'(scaled);
endmodule
