// Residual-systematic resampling: a weight a cycle, how many children it has, and what is left for the next.
//
//   x_i = w_i q + v_i,  n_i = floor(x_i),  v_(i+1) = x_i - n_i;   q = N / T,  T = sum w,  v_0 ~ U[0, 1) of 24 bits
//   w_i as Width bits of T (mote_share), of which all but 17 are carried to the next weight; the last particle has the children
//   that are left
//
// These are mote_offspring's children: n_0 + ... + n_i = floor(C_i q + v_0). N / T is a factor (mote_reciprocal), never too
// large. No child is drawn when no step follows.
//
// formats  short_i, rise_i, scale_i: mote_weight's, of the scale its 3 lowest bits
// range    1 <= n_i <= 2^At, At >= 6
// timing   weights are read from 2 Product - 1 cycles after total_valid_i on, which comes a cycle after the last weight; a particle's
//          first child shows 9 + Product cycles after it is read, one child a cycle. A queue of Parents lets it run ahead
// golden   mote/hardware/filters/residual.hpp
// source   Bolic, Djuric & Hong 2003 (residual-systematic resampling)
module mote_residual_systematic #(
    parameter int unsigned At         = 10,
    parameter int unsigned Width      = 24,
    parameter int unsigned Parents    = 128,
    parameter int unsigned Product    = 1,
    localparam int unsigned SumWidth  = Width + At
) (
    input  logic                         clk_i,
    input  logic                         rst_ni,
    input  logic        [At:0]           n_i,
    // weights, slot after slot
    input  logic                         write_i,
    input  logic                         last_i,
    input  logic        [17:0]           short_i,
    input  logic        [1:0]            rise_i,
    input  logic        [2:0]            scale_i,
    // the end of a step
    input  logic                         total_valid_i,
    input  logic        [SumWidth-1:0]   total_i,
    input  logic        [23:0]           uniform_i,
    input  logic                         more_i,  // a step follows
    // parents, child after child
    output logic                         valid_o,
    input  logic                         ready_i,
    output logic        [At-1:0]         parent_o
);
  localparam int unsigned Latency = 8 + Product;     // from reading a weight to its children
  localparam int unsigned Drop = At - 6;             // bits of N times the reciprocal that are left out
  localparam int unsigned Frac = 34 - Drop;          // fraction bits of w q
  localparam int unsigned Rest = Width - 17;         // bits of a weight that are carried to the next
  localparam int unsigned RoomWidth = $clog2(Parents) + 1;
  localparam int unsigned ZerosWidth = $clog2(SumWidth);
  typedef logic [At:0] count_t;

  // ---- memory of weights, two banks
  logic [At-1:0] written_q;
  logic bank_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      written_q <= '0;
      bank_q    <= 1'b0;
    end else if (write_i) begin
      written_q <= last_i ? '0 : written_q + At'(1);
      bank_q    <= bank_q ^ last_i;
    end
  end

  // ---- reading, as long as the queue will have room
  logic begins, more, reads, last_read, pop, left_out;  // the factor is there by the time that it is needed
  mote_valid #(.Depth(2 * (Product - 1))) u_begins (.clk_i, .rst_ni, .valid_i(total_valid_i), .valid_o(begins));
  mote_delay #(.Width(1), .Depth(2 * (Product - 1))) u_more (.clk_i, .d_i(more_i), .d_o(more));
  count_t left_q;
  logic [RoomWidth-1:0] room_q;
  logic [At-1:0] slot_q;
  assign reads = left_q != '0 && room_q != '0;
  assign last_read = left_q == (At + 1)'(1);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q <= '0;
      room_q <= RoomWidth'(Parents);
    end else begin
      if (begins) left_q <= more ? n_i : '0;
      else if (reads) left_q <= left_q - (At + 1)'(1);
      room_q <= room_q - RoomWidth'(reads) + RoomWidth'(pop) + RoomWidth'(left_out);
    end
  end
  always_ff @(posedge clk_i) begin
    if (begins) slot_q <= '0;
    else if (reads) slot_q <= slot_q + At'(1);
  end
  logic [17:0] word;
  mote_ram #(.Width(18), .Words(2 << At)) u_weights (
      .clk_i,
      .write_i,
      .write_at_i({bank_q, written_q}),
      .write_word_i(short_i),
      .read_at_i({~bank_q, slot_q}),
      .read_word_o(word));

  // ---- the factor N / T
  logic [ZerosWidth-1:0] zeros;
  logic [17:0] reciprocal;
  logic [At+18:0] product_n;
  logic [23:0] factor_q;
  logic unused_product;
  mote_reciprocal #(.Width(SumWidth), .MostZeros(At + 8), .Product(Product)) u_reciprocal (
      .clk_i, .load_i(total_valid_i), .divisor_i(total_i), .zeros_o(zeros), .reciprocal_o(reciprocal));
  mote_times #(.AWidth(18), .BWidth(At + 1), .Product(Product)) u_product_n (
      .clk_i, .a_i(reciprocal), .b_i(n_i), .p_o(product_n));
  always_ff @(posedge clk_i) factor_q <= product_n[Drop+:24];
  assign unused_product = ^product_n;

  // ---- shares of T: what is cut off goes to the next weight
  logic [At-1:0] faint_before;
  logic [2:0] level;
  logic [5:0] by;
  logic [6:0] mask;
  logic faint;
  logic [Width-1:0] share, sum;
  logic [Rest-1:0] rest_q;
  logic [16:0] share_q;
  logic share_valid;
  mote_scales #(.At(At), .SlotWidth(At), .ZerosWidth(ZerosWidth)) u_scales (
      .clk_i, .write_i, .last_i, .slot_i(written_q), .rise_i, .scale_i, .zeros_i(zeros),
      .faint_before_o(faint_before), .level_o(level), .by_o(by), .mask_o(mask));
  mote_delay #(.Width(1), .Depth(2)) u_faint (.clk_i, .d_i(slot_q < faint_before), .d_o(faint));
  mote_share #(.Width(Width)) u_share (
      .clk_i, .short_i(word), .faint_i(faint), .by_i(by), .level_i(level), .mask_i(mask), .share_o(share));
  mote_valid #(.Depth(5)) u_share_valid (.clk_i, .rst_ni, .valid_i(reads), .valid_o(share_valid));
  assign sum = share + Width'(rest_q);
  always_ff @(posedge clk_i) begin
    share_q <= sum[Width-1:Rest];
    if (total_valid_i) rest_q <= '0;
    else if (share_valid) rest_q <= sum[Rest-1:0];
  end

  // ---- children, and the residual
  logic [40:0] product, product2_q, place;
  mote_times #(.AWidth(24), .BWidth(17), .Product(Product)) u_product (
      .clk_i, .a_i(factor_q), .b_i(share_q), .p_o(product));
  logic [Frac-1:0] residual_q;
  logic place_valid, last8, child_valid_q;
  logic [At-1:0] slot8, child_slot_q;
  count_t children, children_q, children_left_q;
  mote_valid #(.Depth(Latency - 1)) u_place_valid (.clk_i, .rst_ni, .valid_i(reads), .valid_o(place_valid));
  mote_delay #(.Width(At + 1), .Depth(Latency - 1)) u_slot (.clk_i, .d_i({last_read, slot_q}), .d_o({last8, slot8}));
  assign place = product2_q + 41'(residual_q);
  assign children = last8 ? children_left_q : place[Frac+:At+1];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) child_valid_q <= 1'b0;
    else child_valid_q <= place_valid;
  end
  always_ff @(posedge clk_i) begin
    product2_q <= product;
    if (total_valid_i) begin
      residual_q      <= {uniform_i, {(Frac - 24) {1'b0}}};
      children_left_q <= n_i;
    end else if (place_valid) begin
      residual_q      <= place[Frac-1:0];
      children_left_q <= children_left_q - children;
    end
    children_q   <= children;
    child_slot_q <= slot8;
  end
  assign left_out = child_valid_q && children_q == '0;

  // ---- parents, each as often as it has children
  count_t repeats, shown_q;
  logic no_parent, unused_full;
  mote_fifo #(.Width(2 * At + 1), .Depth(Parents)) u_parents (
      .clk_i, .rst_ni, .clear_i(1'b0),
      .push_i(child_valid_q && !left_out), .word_i({child_slot_q, children_q}),
      .pop_i(pop), .word_o({parent_o, repeats}), .empty_o(no_parent), .full_o(unused_full));
  assign valid_o = !no_parent;
  assign pop = valid_o && ready_i && shown_q + (At + 1)'(1) == repeats;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) shown_q <= '0;
    else if (valid_o && ready_i) shown_q <= pop ? '0 : shown_q + (At + 1)'(1);
  end
endmodule
