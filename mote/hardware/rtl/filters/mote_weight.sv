// Weights from log weights, by one pass: 2^lw at a scale that rises with the largest weight so far; a row of Lanes
// weights a cycle.
//
//   scale(n)  = max(scale(n - 1), floor(lw / 8) + 1 of every lane), quanta of 8 octaves; first_i begins anew
//   weight_o  = floor(2^(lw - 8 scale) 2^Width),   rise_o = scale(n) - scale(n - 1), at most 7
//
// So no pass for the maximum is needed, and an observation far from every particle still tells them apart. Who adds
// weights shifts his sum down by 8 rise_o bits first; the largest weight of a step is at least 2^(Width - 8).
//
// formats  log_weight_i: signed, LogWidth bits, 10 fraction bits, octaves; weight_o: unsigned, below 2^Width
// error    2^-15 of the weight by the table, and 2^-Width of the scale by truncation
// timing   latency 5, initiation interval 1, up to 4 lanes at full speed (the greatest of a row in one stage); scale_o goes with weight_o, scale_early_o is 3 cycles ahead of it
// golden   mote/hardware/filters/weights.hpp
module mote_weight #(
    parameter int unsigned Lanes    = 1,
    parameter int unsigned LogWidth = 24,
    parameter int unsigned Width    = 24,
    parameter Table                 = "exp2.hex",
    localparam int unsigned Frac    = 10,
    localparam int unsigned ScaleWidth = LogWidth - Frac - 3 + 1
) (
    input  logic                         clk_i,
    input  logic                         rst_ni,
    input  logic                         valid_i,
    input  logic                         first_i,
    input  logic [Lanes*LogWidth-1:0]    log_weight_i,
    output logic                         valid_o,
    output logic                         first_o,
    output logic        [2:0]            rise_o,
    output logic [Lanes*Width-1:0]       weight_o,
    output logic signed [ScaleWidth-1:0] scale_o,
    output logic signed [ScaleWidth-1:0] scale_early_o
);
  typedef logic signed [ScaleWidth-1:0] scale_t;
  // Differences of scales are never negative here.
  function automatic logic [2:0] limited(input logic [ScaleWidth-1:0] difference);
    limited = difference > ScaleWidth'(7) ? 3'd7 : difference[2:0];
  endfunction

  logic [15:0] table_rom[1<<Frac];
  initial $readmemh(Table, table_rom);

  // 1: the scale that each weight asks for, and the greatest of them.
  logic [Lanes*ScaleWidth-1:0] need;
  scale_t             most, most_q;
  logic               valid1_q, first1_q;
  always_comb begin
    most = need[0+:ScaleWidth];
    for (int l = 1; l < Lanes; l++)
      if ($signed(need[l*ScaleWidth+:ScaleWidth]) > most) most = need[l*ScaleWidth+:ScaleWidth];
  end
  always_ff @(posedge clk_i) begin
    most_q   <= most;
    first1_q <= first_i;
  end

  // 2: the scale so far.
  scale_t     scale_q;
  logic       rises;
  logic [2:0] rise2_q;
  logic       valid2_q, first2_q;
  assign rises = first1_q || most_q > scale_q;
  always_ff @(posedge clk_i) begin
    if (valid1_q && rises) scale_q <= most_q;
    rise2_q  <= rises && !first1_q ? limited(most_q - scale_q) : 3'd0;
    first2_q <= first1_q;
  end
  assign scale_early_o = scale_q;

  // 3, 4, 5: how far below the scale each weight is; shift.
  logic [2:0] rise3_q, rise4_q;
  scale_t     scale3_q, scale4_q;
  logic       valid3_q, first3_q, valid4_q, first4_q;
  always_ff @(posedge clk_i) begin
    rise3_q  <= rise2_q;
    scale3_q <= scale_q;
    first3_q <= first2_q;
    rise4_q  <= rise3_q;
    scale4_q <= scale3_q;
    first4_q <= first3_q;
    rise_o   <= rise4_q;
    scale_o  <= scale4_q;
    first_o  <= first4_q;
  end
  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    logic signed [LogWidth-1:0] log_weight;
    scale_t           need_q, need2_q;
    logic [Frac+2:0]  below_q;
    logic [2:0]       fine2_q, coarse3_q, fine3_q, fine4_q;
    logic [15:0]      power_q, power3_q;
    logic [Width-1:0] shifted_q;
    assign log_weight = log_weight_i[l*LogWidth+:LogWidth];
    assign need[l*ScaleWidth+:ScaleWidth] = ScaleWidth'(log_weight >>> (Frac + 3)) + ScaleWidth'(1);
    always_ff @(posedge clk_i) begin
      need_q      <= need[l*ScaleWidth+:ScaleWidth];
      below_q     <= log_weight[Frac+2:0];
      need2_q     <= need_q;
      fine2_q     <= ~below_q[Frac+2:Frac];
      power_q     <= table_rom[below_q[Frac-1:0]];
      coarse3_q   <= limited(scale_q - need2_q);
      fine3_q     <= fine2_q;
      power3_q    <= power_q;
      shifted_q   <= {power3_q, {(Width - 16) {1'b0}}} >> {coarse3_q, 3'b0};
      fine4_q     <= fine3_q;
      weight_o[l*Width+:Width] <= shifted_q >> fine4_q;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {valid1_q, valid2_q, valid3_q, valid4_q, valid_o} <= '0;
    else {valid1_q, valid2_q, valid3_q, valid4_q, valid_o} <= {valid_i, valid1_q, valid2_q, valid3_q, valid4_q};
  end
endmodule
