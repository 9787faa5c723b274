// What a step says of the state: sums over weighted values, the mean by division, and a stream that carries both out.
//
//   sum = sum_j w_j,   mean = (sum_j v_j x_j) / den,   den = sum, or count_i 2^16 for equal values (equal_i)
//
// Sums follow a rising scale: before a term comes in, the sum so far goes down by 8 rise bits (floor).
//
// formats  weights: unsigned; values: Dims signed words; mean_o: signed, Extra fraction bits more than the values;
//          evidence of a step = sum_o 2^(8 scale_o - Width) / proposals
// range    |sum v x| <= 2^(ValueWidth - 1) sum v, SumWidth bits hold 2^At weights: nothing overflows
// timing   sums: one term a cycle; 4 cycles from done_i to taking the sums, then 1 + Dims (ValueWidth + Extra + 1) to
//          divide. Sums must not begin anew before they are taken: the filter begins a step only when the one before
//          the last has left, see pending_o
// golden   mote/hardware/filters/estimate.hpp
module mote_estimate #(
    parameter int unsigned Dims       = 1,
    parameter int unsigned ValueWidth = 18,
    parameter int unsigned Width      = 24,
    parameter int unsigned At         = 10,
    parameter int unsigned Extra      = 8,
    parameter int unsigned ScaleWidth = 12,
    localparam int unsigned SumWidth  = Width + At,
    localparam int unsigned MeanWidth = ValueWidth + Extra + 1
) (
    input  logic                                  clk_i,
    input  logic                                  rst_ni,
    // weights
    input  logic                                  weight_valid_i,
    input  logic                                  weight_first_i,
    input  logic        [2:0]                     weight_rise_i,
    input  logic        [Width-1:0]               weight_i,
    input  logic signed [ScaleWidth-1:0]          scale_i,
    output logic        [SumWidth-1:0]            sum_so_far_o,
    // values, each with the weight it goes by
    input  logic                                  value_valid_i,
    input  logic                                  value_first_i,
    input  logic        [2:0]                     value_rise_i,
    input  logic        [Width-1:0]               value_weight_i,
    input  logic        [Dims-1:0][ValueWidth-1:0] value_i,
    // end of a step
    input  logic                                  done_i,
    input  logic                                  last_i,
    input  logic                                  equal_i,
    input  logic        [At:0]                    count_i,
    input  logic        [At:0]                    accepted_i,
    output logic                                  pending_o,
    // stream of estimates
    output logic                                  valid_o,
    input  logic                                  ready_i,
    output logic                                  last_o,
    output logic        [Dims-1:0][MeanWidth-1:0] mean_o,
    output logic        [SumWidth-1:0]            sum_o,
    output logic signed [ScaleWidth-1:0]          scale_o,
    output logic        [At:0]                    accepted_o
);
  localparam int unsigned TotalWidth = SumWidth + ValueWidth;
  localparam int unsigned Bits = ValueWidth + Extra;
  localparam int unsigned CountWidth = $clog2(Bits + 1);
  typedef logic signed [TotalWidth-1:0] total_t;

  // ---- sums
  logic [SumWidth-1:0] sum_q;
  logic signed [ScaleWidth-1:0] scale_q;
  always_ff @(posedge clk_i) begin
    if (weight_valid_i) begin
      sum_q <= (weight_first_i ? '0 : sum_q >> {weight_rise_i, 3'b0}) + SumWidth'(weight_i);
      scale_q <= scale_i;
    end
  end
  assign sum_so_far_o = sum_q;

  logic valid1_q, valid2_q, valid3_q, first1_q, first2_q, first3_q;
  logic [2:0] rise1_q, rise2_q, rise3_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {valid1_q, valid2_q, valid3_q} <= '0;
    else {valid1_q, valid2_q, valid3_q} <= {value_valid_i, valid1_q, valid2_q};
  end
  always_ff @(posedge clk_i) begin
    {first1_q, first2_q, first3_q} <= {value_first_i, first1_q, first2_q};
    {rise1_q, rise2_q, rise3_q} <= {value_rise_i, rise1_q, rise2_q};
  end
  total_t total[Dims];
  for (genvar d = 0; d < Dims; d++) begin : gen_total
    logic signed [Width:0] weight_q;
    logic signed [ValueWidth-1:0] value_q;
    logic signed [Width+ValueWidth:0] product_q, product2_q;
    total_t total_q, lowered;
    assign lowered = total_q >>> {rise3_q, 3'b0};
    always_ff @(posedge clk_i) begin
      weight_q   <= $signed({1'b0, value_weight_i});
      value_q    <= $signed(value_i[d]);
      product_q  <= weight_q * value_q;
      product2_q <= product_q;
      if (valid3_q) total_q <= (first3_q ? total_t'(0) : lowered) + total_t'(product2_q);
    end
    assign total[d] = total_q;
  end

  // ---- the end of a step, when the last value is in
  logic [2:0] done_q, last_q;
  logic pending_q, pending_last_q, take;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      done_q <= '0;
      pending_q <= 1'b0;
    end else begin
      done_q <= {done_q[1:0], done_i};
      if (done_q[2]) pending_q <= 1'b1;
      else if (take) pending_q <= 1'b0;
    end
  end
  always_ff @(posedge clk_i) begin
    last_q <= {last_q[1:0], last_i};
    if (done_q[2]) pending_last_q <= last_q[2];
  end
  assign pending_o = pending_q;

  // ---- division, one value after the other, one bit a cycle
  logic busy_q;
  logic [CountWidth-1:0] count_q;
  logic [Dims-1:0] turn_q;
  logic [Dims-1:0][TotalWidth-1:0] left_q;
  logic [SumWidth-1:0] divisor_q;
  logic [SumWidth-1:0] rest_q;
  logic [Bits-1:0] quotient_q;
  logic negative_q;
  logic [SumWidth:0] doubled;
  logic [SumWidth-1:0] reduced;
  logic fits;
  logic [TotalWidth-1:0] magnitude;
  assign take = pending_q && !busy_q && !valid_o;
  assign magnitude = left_q[0][TotalWidth-1] ? -left_q[0] : left_q[0];
  assign doubled = {rest_q, quotient_q[Bits-1]};
  assign fits = doubled >= {1'b0, divisor_q};
  assign reduced = SumWidth'(fits ? doubled - {1'b0, divisor_q} : doubled);

  logic loading, finished;
  assign loading = count_q == '0;
  assign finished = count_q == CountWidth'(Bits);
  logic [Bits-1:0] quotient_d;
  assign quotient_d = {quotient_q[Bits-2:0], fits};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q <= 1'b0;
      valid_o <= 1'b0;
    end else begin
      if (take) busy_q <= 1'b1;
      else if (finished && turn_q[0]) busy_q <= 1'b0;
      if (busy_q && finished && turn_q[0]) valid_o <= 1'b1;
      else if (ready_i) valid_o <= 1'b0;
    end
  end
  always_ff @(posedge clk_i) begin
    if (take) begin
      divisor_q  <= equal_i ? SumWidth'(count_i) << 16 : sum_q;
      sum_o      <= sum_q;
      scale_o    <= scale_q;
      accepted_o <= accepted_i;
      last_o     <= pending_last_q;
      turn_q     <= Dims'(1) << (Dims - 1);
      count_q    <= '0;
      for (int d = 0; d < Dims; d++) left_q[d] <= total[d];
    end else if (busy_q) begin
      if (loading) begin
        rest_q     <= SumWidth'(magnitude >> ValueWidth);
        quotient_q <= {magnitude[ValueWidth-1:0], {Extra{1'b0}}};
        negative_q <= left_q[0][TotalWidth-1];
      end else begin
        rest_q     <= reduced;
        quotient_q <= quotient_d;
      end
      if (finished) begin
        mean_o  <= shifted_in(mean_o, negative_q ? -{1'b0, quotient_d} : {1'b0, quotient_d});
        left_q  <= left_q >> TotalWidth;
        turn_q  <= turn_q >> 1;
        count_q <= '0;
      end else begin
        count_q <= count_q + CountWidth'(1);
      end
    end
  end
  // Means come in the order of the values: each enters at the top and moves the others down.
  function automatic logic [Dims-1:0][MeanWidth-1:0] shifted_in(input logic [Dims-1:0][MeanWidth-1:0] so_far,
                                                               input logic [MeanWidth-1:0] mean);
    logic [Dims-1:0][MeanWidth-1:0] moved;
    moved = so_far >> MeanWidth;
    moved[Dims-1] = mean;
    return moved;
  endfunction
endmodule
