// mote_cordic: rotations by shifts and additions, a register behind each.
//
// equation  x' = x - m d (y >> k), y' = y + d (x >> k), z' = z - d angle_k; m = 1, 0, -1 for Mode 0 circular, 1 linear, 2 hyperbolic
//           Vectoring = 0: d is the sign of z, so z goes to 0; Vectoring = 1: d is the opposite sign of y, so y goes to 0 (x > 0)
// formats   x, y: signed, Width bits; z: signed, ZWidth bits; shifts are rounded down. Angles holds stage 0 in its lowest ZWidth bits,
//           Shifts holds k of stage 0 in its lowest 8 bits
// range     nothing saturates: the caller leaves room for the gain and for z's sum
// timing    latency Stages, one rotation a clock; a stage is three adders side by side
// twin      Cordic in mote/hardware/cordic.hpp
// source    Walther 1971, A unified algorithm for elementary functions
module mote_cordic #(
    parameter int Mode = 0,
    parameter bit Vectoring = 1'b0,
    parameter int Width = 18,
    parameter int ZWidth = 18,
    parameter int Stages = 2,
    parameter logic [Stages*8-1:0] Shifts = {8'd1, 8'd0},
    parameter logic [Stages*ZWidth-1:0] Angles = {18'd15193, 18'd25736}
) (
    input  logic                     clk_i,
    input  logic signed [ Width-1:0] x_i,
    input  logic signed [ Width-1:0] y_i,
    input  logic signed [ZWidth-1:0] z_i,
    output logic signed [ Width-1:0] x_o,
    output logic signed [ Width-1:0] y_o,
    output logic signed [ZWidth-1:0] z_o
);

  for (genvar k = 0; k < Stages; k++) begin : gen_stages
    localparam int Shift = 32'(Shifts[8*k+:8]);
    localparam logic signed [ZWidth-1:0] Angle = Angles[ZWidth*k+:ZWidth];
    logic signed [Width-1:0] x, y, x_q, y_q, dx, dy;
    logic signed [ZWidth-1:0] z, z_q;
    logic negative;
    if (k == 0) begin : gen_first
      assign {x, y, z} = {x_i, y_i, z_i};
    end else begin : gen_next
      assign {x, y, z} = {gen_stages[k-1].x_q, gen_stages[k-1].y_q, gen_stages[k-1].z_q};
    end
    assign dx = y >>> Shift;
    assign dy = x >>> Shift;
    assign negative = Vectoring ? !y[Width-1] : z[ZWidth-1];
    always_ff @(posedge clk_i) begin
      x_q <= Mode == 1 ? x : (negative == (Mode == 0)) ? x + dx : x - dx;
      y_q <= negative ? y - dy : y + dy;
      z_q <= negative ? z + Angle : z - Angle;
    end
  end

  assign {x_o, y_o, z_o} = {gen_stages[Stages-1].x_q, gen_stages[Stages-1].y_q, gen_stages[Stages-1].z_q};

endmodule
