// A loop over 0 .. n_i - 1: an index every Interval cycles, from the cycle after begin_i on.
//
// timing   index_o and last_o go with valid_o, which waits for ready_i
module mote_loop #(
    parameter int unsigned At       = 10,
    parameter int unsigned Interval = 1
) (
    input  logic          clk_i,
    input  logic          rst_ni,
    input  logic          begin_i,
    input  logic [At:0]   n_i,
    input  logic          ready_i,
    output logic          valid_o,
    output logic          last_o,
    output logic [At-1:0] index_o
);
  localparam int unsigned TickWidth = Interval > 1 ? $clog2(Interval) : 1;
  logic runs_q;
  logic [TickWidth-1:0] tick_q;
  assign valid_o = runs_q && tick_q == '0 && ready_i;
  assign last_o = valid_o && {1'b0, index_o} + (At + 1)'(1) == n_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      runs_q  <= 1'b0;
      tick_q  <= '0;
      index_o <= '0;
    end else if (begin_i) begin
      runs_q  <= 1'b1;
      tick_q  <= '0;
      index_o <= '0;
    end else begin
      if (valid_o) begin
        index_o <= index_o + At'(1);
        if (last_o) runs_q <= 1'b0;
      end
      tick_q <= valid_o ? TickWidth'(Interval - 1) : tick_q == '0 ? '0 : tick_q - TickWidth'(1);
    end
  end
endmodule
