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
// timing   latency 3 + log2 Lanes, initiation interval 1. Log weights come from registers
// golden   mote/hardware/filters/weights.hpp
module mote_weight #(
    parameter int unsigned Lanes    = 1,
    parameter int unsigned LogWidth = 24,
    parameter int unsigned Width    = 24,
    parameter Table                 = "exp2.hex",
    parameter bit TableLogic        = 1'b0,  // mote_rom's Logic
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
  localparam int unsigned Before = $clog2(Lanes);  // stages that look for a row's greatest
  typedef logic signed [ScaleWidth-1:0] scale_t;
  // Differences of scales are never negative here.
  function automatic logic [1:0] limited(input logic [ScaleWidth-1:0] difference);
    limited = difference > ScaleWidth'(3) ? 2'd3 : difference[1:0];
  endfunction

  // 2^f - 1 of the fraction f of each log weight; a block of memory has two lanes' ports.
  logic [Lanes*12-1:0] power_q;
  if (TableLogic) begin : gen_logic
    for (genvar l = 0; l < Lanes; l++) begin : gen_lane
      mote_rom #(.AddressWidth(Frac), .Width(12), .OutRegister(1'b0), .Logic(1'b1), .File(Table)) u_power (
          .clk_i, .address_i(log_weight_i[l*LogWidth+:Frac]), .word_o(power_q[l*12+:12]));
    end
  end else begin : gen_block
    logic [11:0] table_rom[1<<Frac];
    initial $readmemh(Table, table_rom);
    always_ff @(posedge clk_i)
      for (int l = 0; l < Lanes; l++) power_q[l*12+:12] <= table_rom[log_weight_i[l*LogWidth+:Frac]];
  end

  // The floors of lw / 8, one below the scale that each weight asks for, and the greatest of them.
  localparam int unsigned FloorWidth = ScaleWidth - 1;
  logic [Lanes*FloorWidth-1:0] floors, floors_then;
  scale_t most;
  logic   valid, first;
  for (genvar l = 0; l < Lanes; l++) begin : gen_floor
    assign floors[l*FloorWidth+:FloorWidth] = log_weight_i[(l+1)*LogWidth-1-:FloorWidth];
  end
  mote_row #(.Lanes(Lanes), .Width(FloorWidth), .RowWidth(ScaleWidth), .Signed(1'b1), .Greatest(1'b1)) u_most (
      .clk_i, .word_i(floors), .row_o(most));
  mote_valid #(.Depth(Before)) u_valid (.clk_i, .rst_ni, .valid_i, .valid_o(valid));
  mote_valid #(.Depth(Before)) u_first (.clk_i, .rst_ni, .valid_i(first_i), .valid_o(first));
  mote_delay #(.Width(Lanes * FloorWidth), .Depth(Before)) u_floors (.clk_i, .d_i(floors), .d_o(floors_then));

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
    scale_t      floor_q;
    logic [2:0]  fine_q, fine, fine2_q;
    logic [1:0]  coarse2_q;
    logic [11:0] power, power2_q;
    mote_delay #(.Width(15), .Depth(Before)) u_mantissa (.clk_i, .d_i({fine_q, power_q[l*12+:12]}), .d_o({fine, power}));
    always_ff @(posedge clk_i or negedge rst_ni) begin  // a reset keeps them out of slow shift registers
      if (!rst_ni) {floor_q, fine2_q, power2_q} <= '0;
      else {floor_q, fine2_q, power2_q} <= {ScaleWidth'($signed(floors_then[l*FloorWidth+:FloorWidth])), fine, power};
    end
    always_ff @(posedge clk_i) begin
      fine_q    <= ~log_weight_i[l*LogWidth+Frac+:3];
      coarse2_q <= limited(level_q - floor_q);
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
