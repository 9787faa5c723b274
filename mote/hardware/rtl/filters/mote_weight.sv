// Weights from log weights, by one pass: 2^lw at a scale that rises with the largest weight so far; a row of Lanes
// weights a cycle.
//
//   scale(n)  = max(scale(n - 1), floor(lw / 8) + 1 of every lane), quanta of 8 octaves; first_i begins anew
//   weight_o  = floor(2^(lw - 8 scale) 2^Width), 0 from 3 quanta below the scale on
//   short_o   = {floor(lw) mod 64, 12 bits of the mantissa behind its leading one}: the same weight to be kept (mote_share);
//               what is nothing stands 3 quanta below the scale
//   rise_o    = scale(n) - scale(n - 1), at most 3; 3 for the first: nothing before it counts
//
// So no pass for the maximum is needed, and an observation far from every particle still tells them apart. Who adds
// weights shifts his sum down by 8 rise_o bits first, or drops it at 3; the largest weight of a step is at least
// 2^(Width - 8).
//
// formats  log_weight_i: signed, LogWidth bits, 10 fraction bits, octaves; weight_o: unsigned, below 2^Width
// error    2^-13 of the weight by the table, and 2^-Width of the scale by truncation
// timing   latency 3, with several lanes 4; initiation interval 1. Log weights come from registers
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
    output logic        [1:0]            rise_o,
    output logic [Lanes*Width-1:0]       weight_o,
    output logic [Lanes*18-1:0]          short_o,
    output logic signed [ScaleWidth-1:0] scale_o
);
  localparam int unsigned Before = Lanes > 1 ? 1 : 0;  // the stage that looks for a row's greatest
  typedef logic signed [ScaleWidth-1:0] scale_t;
  // Differences of scales are never negative here.
  function automatic logic [1:0] limited(input logic [ScaleWidth-1:0] difference);
    limited = difference > ScaleWidth'(3) ? 2'd3 : difference[1:0];
  endfunction

  logic [11:0] table_rom[1<<Frac];
  initial $readmemh(Table, table_rom);

  // The floors of lw / 8, one below the scale that each weight asks for, and the greatest of them.
  logic [Lanes*LogWidth-1:0] log_weights;
  scale_t floor, most_d, most;
  logic   valid, first;
  always_comb begin
    most_d = ScaleWidth'($signed(log_weight_i[LogWidth-1-:ScaleWidth-1]));
    for (int l = 1; l < Lanes; l++) begin
      floor = ScaleWidth'($signed(log_weight_i[(l+1)*LogWidth-1-:ScaleWidth-1]));
      if (floor > most_d) most_d = floor;
    end
    if (Lanes == 1) floor = '0;
  end
  mote_valid #(.Depth(Before)) u_valid (.clk_i, .rst_ni, .valid_i, .valid_o(valid));
  mote_delay #(.Width(ScaleWidth + 1 + Lanes * LogWidth), .Depth(Before)) u_row (
      .clk_i, .d_i({most_d, first_i, log_weight_i}), .d_o({most, first, log_weights}));

  // The greatest so far; how far it rises.
  scale_t     level_q, level2_q;
  logic signed [ScaleWidth:0] gain_q;
  logic [1:0] rise2_q;
  logic       first_q, valid1_q, valid2_q;
  always_ff @(posedge clk_i) begin
    if (valid && (first || most > level_q)) level_q <= most;
    gain_q   <= (ScaleWidth + 1)'(most) - (ScaleWidth + 1)'(level_q);
    first_q  <= first;
    rise2_q  <= first_q ? 2'd3 : gain_q[ScaleWidth] ? 2'd0 : limited(gain_q[ScaleWidth-1:0]);
    level2_q <= level_q;
    rise_o   <= rise2_q;
    scale_o  <= level2_q + ScaleWidth'(1);
  end

  // How far below the scale each weight is; shift.
  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    logic signed [LogWidth-1:0] log_weight;
    scale_t      floor_q;
    logic [2:0]  fine_q, fine2_q;
    logic [1:0]  coarse2_q;
    logic [11:0] power_q, power2_q;
    assign log_weight = log_weights[l*LogWidth+:LogWidth];
    always_ff @(posedge clk_i) begin
      floor_q   <= ScaleWidth'(log_weight >>> (Frac + 3));
      fine_q    <= ~log_weight[Frac+2:Frac];
      power_q   <= table_rom[log_weight[Frac-1:0]];
      coarse2_q <= limited(level_q - floor_q);
      fine2_q   <= fine_q;
      power2_q  <= power_q;
      weight_o[l*Width+:Width] <= coarse2_q == 2'd3 ? '0
                                : {1'b1, power2_q, {(Width - 13) {1'b0}}} >> {coarse2_q, 3'b0} >> fine2_q;
      short_o[l*18+:18] <= {level2_q[2:0] - 3'(coarse2_q), ~fine2_q, power2_q};
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {valid1_q, valid2_q, valid_o} <= '0;
    else {valid1_q, valid2_q, valid_o} <= {valid, valid1_q, valid2_q};
  end
endmodule
