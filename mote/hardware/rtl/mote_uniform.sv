// mote_uniform: 32 uniform bits a clock, by four shift registers with feedback whose outputs are added without carries.
//
// equation  LFSR113: z_k' = ((z_k & mask_k) << s_k) ^ (((z_k << q_k) ^ z_k) >> b_k), u = z_1 ^ z_2 ^ z_3 ^ z_4; period about 2^113
// formats   u: 32 bits, any of which may be read as a number of its own
// range     Seed holds z_4, z_3, z_2, z_1; they must be at least 128, 16, 8 and 2, else a register stands still
// timing    latency 1 from en_i to the next word; without en_i the word stays. rst_ni sets the seed; the first word follows the first en_i
// twin      Tausworthe in mote/hardware/uniform.hpp, which also seeds a register for each stream
// source    L'Ecuyer 1999, Tables of maximally equidistributed combined LFSR generators
module mote_uniform #(
    parameter logic [127:0] Seed = {32'd987654321, 32'd987654321, 32'd987654321, 32'd987654321}
) (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        en_i,
    output logic [31:0] u_o
);

  logic [31:0] z1_q, z2_q, z3_q, z4_q, z1_d, z2_d, z3_d, z4_d;

  assign z1_d = {z1_q[13:1], 1'b0, 18'b0} ^ 32'(({z1_q[25:0], 6'b0} ^ z1_q) >> 13);
  assign z2_d = {z2_q[29:3], 3'b0, 2'b0} ^ 32'(({z2_q[29:0], 2'b0} ^ z2_q) >> 27);
  assign z3_d = {z3_q[24:4], 4'b0, 7'b0} ^ 32'(({z3_q[18:0], 13'b0} ^ z3_q) >> 21);
  assign z4_d = {z4_q[18:7], 7'b0, 13'b0} ^ 32'(({z4_q[28:0], 3'b0} ^ z4_q) >> 12);

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      {z4_q, z3_q, z2_q, z1_q} <= Seed;
      u_o <= '0;
    end else if (en_i) begin
      z1_q <= z1_d;
      z2_q <= z2_d;
      z3_q <= z3_d;
      z4_q <= z4_d;
      u_o  <= z1_d ^ z2_d ^ z3_d ^ z4_d;
    end
  end

endmodule
