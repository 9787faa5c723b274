// What a step says of the state: sums over rows of Lanes weighted values, the mean by division, and a stream that carries
// both out.
//
//   sum = sum_j w_j,   mean = (sum_j v_j x_j) / den,   den = sum, or count_i 2^16 for equal values (equal_i)
//
// Sums follow a rising scale: before a row comes in, the sum so far goes down by 8 rise bits (floor).
//
// formats  weights: unsigned; values: Dims signed words; mean_o: signed, Extra fraction bits more than the values;
//          evidence of a step = sum_o 2^(8 scale_o - Width) / proposals
// range    |sum v x| <= 2^(ValueWidth - 1) sum v, SumWidth bits hold 2^At weights: nothing overflows
// timing   sums: one row a cycle; 4 cycles (5 with several lanes) from done_i to taking the sums, then 1 + Dims (ValueWidth + Extra + 1) to
//          divide. Sums must not begin anew before they are taken: the filter begins a step only when the one before
//          the last has left, see pending_o. Overlapped: they may begin anew in the cycle after done_i, if the estimate
//          before has left by the time they are taken, or does before they begin
// golden   mote/hardware/filters/estimate.hpp
module mote_estimate #(
    parameter int unsigned Lanes      = 1,
    parameter int unsigned Dims       = 1,
    parameter int unsigned ValueWidth = 18,
    parameter int unsigned Width      = 24,
    parameter int unsigned At         = 10,
    parameter int unsigned Extra      = 8,
    parameter int unsigned ScaleWidth = 12,
    parameter int unsigned Overlapped = 0,
    localparam int unsigned SumWidth  = Width + At,
    localparam int unsigned MeanWidth = ValueWidth + Extra + 1
) (
    input  logic                                  clk_i,
    input  logic                                  rst_ni,
    // weights
    input  logic                                  weight_valid_i,
    input  logic                                  weight_first_i,
    input  logic        [2:0]                     weight_rise_i,
    input  logic        [Lanes*Width-1:0]         weight_i,
    input  logic signed [ScaleWidth-1:0]          scale_i,
    output logic        [SumWidth-1:0]            sum_so_far_o,
    // values, each with the weight it goes by
    input  logic                                  value_valid_i,
    input  logic                                  value_first_i,
    input  logic        [2:0]                     value_rise_i,
    input  logic        [Lanes*Width-1:0]         value_weight_i,
    input  logic        [Lanes*Dims*ValueWidth-1:0] value_i,
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
    output logic        [Dims*MeanWidth-1:0]      mean_o,
    output logic        [SumWidth-1:0]            sum_o,
    output logic signed [ScaleWidth-1:0]          scale_o,
    output logic        [At:0]                    accepted_o
);
  localparam int unsigned TotalWidth = SumWidth + ValueWidth;
  localparam int unsigned Bits = ValueWidth + Extra;
  localparam int unsigned CountWidth = $clog2(Bits + 1);
  typedef logic signed [TotalWidth-1:0] total_t;

  localparam int unsigned Tree = Lanes > 1 ? 1 : 0;  // stages that add up a row
  localparam int unsigned Wait = 3 + Tree;

  // ---- sums
  logic [SumWidth-1:0] sum_q, row_d, row;
  logic signed [ScaleWidth-1:0] scale_q, row_scale;
  logic row_valid, row_first;
  logic [2:0] row_rise;
  always_comb begin
    row_d = '0;
    for (int l = 0; l < Lanes; l++) row_d = row_d + SumWidth'(weight_i[l*Width+:Width]);
  end
  mote_valid #(.Depth(Tree)) u_row_valid (.clk_i, .rst_ni, .valid_i(weight_valid_i), .valid_o(row_valid));
  mote_delay #(.Width(SumWidth + ScaleWidth + 4), .Depth(Tree)) u_row (
      .clk_i, .d_i({row_d, scale_i, weight_first_i, weight_rise_i}), .d_o({row, row_scale, row_first, row_rise}));
  always_ff @(posedge clk_i) begin
    if (row_valid) begin
      sum_q <= (row_first ? '0 : sum_q >> {row_rise, 3'b0}) + row;
      scale_q <= row_scale;
    end
  end
  assign sum_so_far_o = sum_q;
  logic [SumWidth-1:0] sum;  // as old as the sums of values are
  logic signed [ScaleWidth-1:0] scale;
  mote_delay #(.Width(SumWidth + ScaleWidth), .Depth(Overlapped == 1 ? Wait - Tree : 0)) u_sum (
      .clk_i, .d_i({sum_q, scale_q}), .d_o({sum, scale}));

  logic value_valid, value_first;
  logic [2:0] value_rise;
  mote_valid #(.Depth(Wait)) u_value_valid (.clk_i, .rst_ni, .valid_i(value_valid_i), .valid_o(value_valid));
  mote_delay #(.Width(4), .Depth(Wait)) u_value (
      .clk_i, .d_i({value_first_i, value_rise_i}), .d_o({value_first, value_rise}));
  localparam int unsigned ProductWidth = Width + ValueWidth + 1;
  logic [Dims*TotalWidth-1:0] total;
  for (genvar d = 0; d < Dims; d++) begin : gen_total
    logic [Lanes*ProductWidth-1:0] products;
    total_t total_q, lowered, terms_d, terms;
    for (genvar l = 0; l < Lanes; l++) begin : gen_lane
      logic signed [Width:0] weight_q;
      logic signed [ValueWidth-1:0] value_q;
      logic signed [ProductWidth-1:0] product_q, product2_q;
      always_ff @(posedge clk_i) begin
        weight_q   <= $signed({1'b0, value_weight_i[l*Width+:Width]});
        value_q    <= $signed(value_i[(l*Dims+d)*ValueWidth+:ValueWidth]);
        product_q  <= weight_q * value_q;
        product2_q <= product_q;
      end
      assign products[l*ProductWidth+:ProductWidth] = product2_q;
    end
    always_comb begin
      terms_d = '0;
      for (int l = 0; l < Lanes; l++) terms_d = terms_d + TotalWidth'($signed(products[l*ProductWidth+:ProductWidth]));
    end
    mote_delay #(.Width(TotalWidth), .Depth(Tree)) u_terms (.clk_i, .d_i(terms_d), .d_o(terms));
    assign lowered = total_q >>> {value_rise, 3'b0};
    always_ff @(posedge clk_i) if (value_valid) total_q <= (value_first ? TotalWidth'(0) : lowered) + terms;
    assign total[d*TotalWidth+:TotalWidth] = total_q;
  end

  // ---- the end of a step, when the last value is in
  logic [Wait-1:0] done_q, last_q;
  logic pending_q, pending_last_q, take;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      done_q <= '0;
      pending_q <= 1'b0;
    end else begin
      done_q <= {done_q[Wait-2:0], done_i};
      if (done_q[Wait-1]) pending_q <= 1'b1;
      else if (take) pending_q <= 1'b0;
    end
  end
  always_ff @(posedge clk_i) begin
    last_q <= {last_q[Wait-2:0], last_i};
    if (done_q[Wait-1]) pending_last_q <= last_q[Wait-1];
  end
  assign pending_o = pending_q;

  // ---- division, one value after the other, one bit a cycle
  logic busy_q;
  logic [CountWidth-1:0] count_q;
  logic [Dims-1:0] turn_q;
  logic [Dims*TotalWidth-1:0] left_q;
  logic [SumWidth-1:0] divisor_q;
  logic [SumWidth-1:0] rest_q;
  logic [Bits-1:0] quotient_q;
  logic negative_q;
  logic [SumWidth:0] doubled;
  logic [SumWidth-1:0] reduced;
  logic fits;
  logic [TotalWidth-1:0] magnitude;
  assign take = pending_q && !busy_q && !valid_o;
  assign magnitude = left_q[TotalWidth-1] ? -left_q[0+:TotalWidth] : left_q[0+:TotalWidth];
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
  // Means come in the order of the values: each enters at the top and moves the others down.
  logic [MeanWidth-1:0] mean;
  logic [Dims*MeanWidth-1:0] means;
  assign mean = negative_q ? -{1'b0, quotient_d} : {1'b0, quotient_d};
  assign means = (Dims * MeanWidth)'({mean, mean_o} >> MeanWidth);
  always_ff @(posedge clk_i) begin
    if (take) begin
      divisor_q  <= equal_i ? SumWidth'(count_i) << 16 : sum;
      sum_o      <= sum;
      scale_o    <= scale;
      accepted_o <= accepted_i;
      last_o     <= pending_last_q;
      turn_q     <= Dims'(1) << (Dims - 1);
      count_q    <= '0;
      left_q     <= total;
    end else if (busy_q) begin
      if (loading) begin
        rest_q     <= SumWidth'(magnitude >> ValueWidth);
        quotient_q <= {magnitude[ValueWidth-1:0], {Extra{1'b0}}};
        negative_q <= left_q[TotalWidth-1];
      end else begin
        rest_q     <= reduced;
        quotient_q <= quotient_d;
      end
      if (finished) begin
        mean_o  <= means;
        left_q  <= left_q >> TotalWidth;
        turn_q  <= turn_q >> 1;
        count_q <= '0;
      end else begin
        count_q <= count_q + CountWidth'(1);
      end
    end
  end
endmodule
