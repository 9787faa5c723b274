// What a step says of the state: sums over rows of Lanes weighted values, the mean by division, and a stream that carries
// both out.
//
//   sum = sum_j w_j,   mean = floor((sum_j v_j x_j) / den),   den = sum, or count_i 2^16 for equal values (equal_i)
//
// Sums follow a rising scale: before a row comes in, the sum so far goes down by 8 rise bits (floor), or begins anew where
// rise is 3. Products are rounded to a unit of weight, as which weights are cut, times the largest value.
//
// formats  weights: unsigned; values: Dims signed words; mean_o: signed, Extra fraction bits more than the values;
//          evidence of a step = sum_o 2^(8 scale_o - Width) / proposals
// range    SumWidth bits hold 2^At weights, and |sum v x| <= 2^(ValueWidth - 1) (sum v + 1): nothing overflows; a step's
//          sum is above 3
// timing   sums: one row a cycle; 3 + Product + log2 Lanes cycles from done_i to taking the sums, then 1 + Dims (ValueWidth + Extra + 1)
//          to divide: a bit a cycle, without restoring. Sums must not begin anew before they are taken: the filter begins a
//          step only when the one before the last has left, see pending_o. Overlapped: they may begin anew in the cycle after
//          done_i, if the estimate before has left by the time they are taken, or does before they begin
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
    parameter int unsigned Product    = 1,
    localparam int unsigned SumWidth  = Width + At,
    localparam int unsigned MeanWidth = ValueWidth + Extra + 1
) (
    input  logic                                  clk_i,
    input  logic                                  rst_ni,
    // weights
    input  logic                                  weight_valid_i,
    input  logic        [1:0]                     weight_rise_i,
    input  logic        [Lanes*Width-1:0]         weight_i,
    input  logic signed [ScaleWidth-1:0]          scale_i,
    output logic        [SumWidth-1:0]            sum_so_far_o,
    // values, each with the weight it goes by
    input  logic                                  value_valid_i,
    input  logic        [1:0]                     value_rise_i,
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
  localparam int unsigned Dropped = ValueWidth - 1;
  localparam int unsigned ProductWidth = Width + 1 + ValueWidth;
  localparam int unsigned TermWidth = ProductWidth - Dropped;
  localparam int unsigned TotalWidth = SumWidth + ValueWidth - Dropped;
  localparam int unsigned Bits = ValueWidth + Extra;  // that the division adds to the sign
  localparam int unsigned CountWidth = $clog2(Bits + 1);
  typedef logic signed [TotalWidth-1:0] total_t;

  localparam int unsigned Tree = $clog2(Lanes);  // stages that add up a row
  localparam int unsigned Wait = 2 + Product + Tree;

  // ---- sums
  logic [SumWidth-1:0] sum_q, row;
  logic signed [ScaleWidth-1:0] scale_q, row_scale;
  logic row_valid;
  logic [1:0] row_rise;
  mote_row #(.Lanes(Lanes), .Width(Width), .RowWidth(SumWidth)) u_row (.clk_i, .word_i(weight_i), .row_o(row));
  mote_valid #(.Depth(Tree)) u_row_valid (.clk_i, .rst_ni, .valid_i(weight_valid_i), .valid_o(row_valid));
  mote_delay #(.Width(ScaleWidth + 2), .Depth(Tree)) u_scale (
      .clk_i, .d_i({scale_i, weight_rise_i}), .d_o({row_scale, row_rise}));
  always_ff @(posedge clk_i) begin
    if (row_valid) begin
      sum_q   <= row + (row_rise == 2'd3 ? '0 : sum_q >> {row_rise, 3'b0});
      scale_q <= row_scale;
    end
  end
  assign sum_so_far_o = sum_q;
  logic [SumWidth-1:0] sum;  // as old as the sums of values are
  logic signed [ScaleWidth-1:0] scale;
  mote_delay #(.Width(SumWidth + ScaleWidth), .Depth(Overlapped == 1 ? Wait - Tree : 0)) u_sum (
      .clk_i, .d_i({sum_q, scale_q}), .d_o({sum, scale}));

  logic value_valid;
  logic [1:0] value_rise, value_rise_q;
  mote_valid #(.Depth(Wait)) u_value_valid (.clk_i, .rst_ni, .valid_i(value_valid_i), .valid_o(value_valid));
  mote_delay #(.Width(2), .Depth(Wait - 1)) u_value_rise (.clk_i, .d_i(value_rise_i), .d_o(value_rise));
  always_ff @(posedge clk_i or negedge rst_ni) begin  // a reset keeps them out of a slow shift register
    if (!rst_ni) value_rise_q <= '0;
    else value_rise_q <= value_rise;
  end
  logic [Dims*TotalWidth-1:0] total;
  for (genvar d = 0; d < Dims; d++) begin : gen_total
    logic [Lanes*TermWidth-1:0] terms;
    logic [TotalWidth-1:0] term, kept, summed;
    logic unused_zero;
    total_t total_q;
    for (genvar l = 0; l < Lanes; l++) begin : gen_lane
      logic signed [Width:0] weight_q;
      logic signed [ValueWidth-1:0] value_q;
      logic [ProductWidth-1:0] product;
      logic signed [ProductWidth-1:0] rounded_q;
      mote_times #(.AWidth(Width + 1), .BWidth(ValueWidth), .BSigned(1'b1), .Product(Product)) u_product (
          .clk_i, .a_i(weight_q), .b_i(value_q), .p_o(product));
      always_ff @(posedge clk_i) begin
        weight_q  <= $signed({1'b0, value_weight_i[l*Width+:Width]});
        value_q   <= $signed(value_i[(l*Dims+d)*ValueWidth+:ValueWidth]);
        rounded_q <= $signed(product) + $signed(ProductWidth'(1) << (Dropped - 1));
      end
      assign terms[l*TermWidth+:TermWidth] = rounded_q[ProductWidth-1:Dropped];
      logic unused_bits;
      assign unused_bits = ^rounded_q[Dropped-1:0];
    end
    mote_row #(.Lanes(Lanes), .Width(TermWidth), .RowWidth(TotalWidth), .Signed(1'b1)) u_terms (
        .clk_i, .word_i(terms), .row_o(term));
    assign kept = value_rise_q == 2'd3 ? TotalWidth'(0) : TotalWidth'(total_q >>> {value_rise_q, 3'b0});
    // term + kept, as a difference, whose sides keep their places: the choice goes into the adder's look-up tables.
    assign {summed, unused_zero} = {term, 1'b0} - {~kept, 1'b1};
    always_ff @(posedge clk_i) if (value_valid) total_q <= summed;
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

  // ---- division, one value after the other: rest' = 2 rest + bit -+ den, by the sign of the rest, which is a quotient's bit
  logic busy_q, finished, ends;
  logic [CountWidth-1:0] count_q;
  logic [Dims-1:0] turn_q;
  logic [Dims*TotalWidth-1:0] left_q;  // values to come, after the first
  total_t next;
  logic [SumWidth-1:0] divisor_q;
  logic [SumWidth:0] rest_q, rest_d;
  logic [Bits-1:0] low_q;  // what is left of the dividend, and the quotient so far
  assign take = pending_q && !busy_q && !valid_o;
  assign finished = count_q == CountWidth'(Bits);
  assign ends = busy_q && finished && turn_q[0];
  assign next = take ? total[0+:TotalWidth] : left_q[0+:TotalWidth];
  logic plus, unused_borrow;  // -den - 1 is ~den
  assign plus = rest_q[SumWidth];
  assign {rest_d, unused_borrow} = {rest_q[SumWidth-1:0], low_q[Bits-1], 1'b0} -
                                   {{1'b0, divisor_q} ^ {(SumWidth + 1) {plus}}, plus};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q <= 1'b0;
      valid_o <= 1'b0;
    end else begin
      if (take) busy_q <= 1'b1;
      else if (ends) busy_q <= 1'b0;
      if (ends) valid_o <= 1'b1;
      else if (ready_i) valid_o <= 1'b0;
    end
  end
  // Means come in the order of the values: each enters at the top and moves the others down.
  logic [MeanWidth-1:0] mean;
  assign mean = {!low_q[Bits-1], low_q[Bits-2:0], !plus};
  always_ff @(posedge clk_i) begin
    if (take) begin
      divisor_q  <= equal_i ? SumWidth'(count_i) << 16 : sum;
      sum_o      <= sum;
      scale_o    <= scale;
      accepted_o <= accepted_i;
      last_o     <= pending_last_q;
      turn_q     <= Dims'(1) << (Dims - 1);
      left_q     <= total >> TotalWidth;
    end else if (busy_q && finished) begin
      mean_o  <= (Dims * MeanWidth)'({mean, mean_o} >> MeanWidth);
      turn_q  <= turn_q >> 1;
      left_q  <= left_q >> TotalWidth;
    end
    if (take || finished) begin
      rest_q  <= (SumWidth + 1)'(next >>> (ValueWidth - Dropped));
      low_q   <= {next[ValueWidth-Dropped-1:0], {(Dropped + Extra) {1'b0}}};
      count_q <= '0;
    end else begin
      rest_q  <= rest_d;
      low_q   <= {low_q[Bits-2:0], !plus};
      count_q <= count_q + CountWidth'(1);
    end
  end
endmodule
