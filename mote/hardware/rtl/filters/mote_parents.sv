// The set of Lanes chains, and a parent for each lane a cycle: uniform over what the lane may choose from.
//
//   slot = floor(u n_i), u of 24 bits; the chain whose slot it is, by Choice:
//     0 private  the lane's own
//     1 banked   (lane + r) mod Lanes, r from lane 0's word: no two lanes read one memory, each parent is uniform over all
//     2 shared   r of the lane's own word: parents are independent, every lane holds a copy of all memories
//
// formats  words as they come: u from the 24 upper bits, r from the bits below. Lanes: a power of two, at most 256
// timing   state_o 3 + Product cycles after advance_i, a cycle more where several lanes take turns (Choice 0 and 1); initiation
//          interval 1; n_i goes a cycle behind advance_i. Two sets: bank_i, of the cycle in which a slot is read (2 before
//          state_o), and the one that is written.
//          Product: mote_times's
// golden   mote/hardware/filters/imh.hpp
module mote_parents #(
    parameter int unsigned Lanes      = 1,
    parameter int unsigned Choice     = 0,
    parameter int unsigned Width      = 18,
    parameter int unsigned CountWidth = 13,
    parameter int unsigned SlotWidth  = 10,
    parameter logic [63:0] Seed       = 64'd1,
    parameter int unsigned Stream     = 0,
    parameter int unsigned StreamStep = 1,
    parameter int unsigned Product    = 1,
    localparam int unsigned LaneWidth = Lanes > 1 ? $clog2(Lanes) : 1
) (
    input  logic                        clk_i,
    input  logic                        rst_ni,
    input  logic                        advance_i,
    input  logic [CountWidth-1:0]       n_i,
    input  logic                        bank_i,
    output logic [Lanes*Width-1:0]      state_o,
    input  logic                        write_i,
    input  logic                        write_bank_i,
    input  logic [SlotWidth-1:0]        write_slot_i,
    input  logic [Lanes*Width-1:0]      write_state_i
);
  typedef logic [LaneWidth-1:0] lane_t;
  localparam int unsigned ProductWidth = CountWidth + 24;

  // ---- slots
  logic [Lanes*32-1:0] word;
  logic [Lanes*SlotWidth-1:0] slot;
  logic [Lanes*LaneWidth-1:0] from;  // the chain that each lane reads from
  for (genvar l = 0; l < Lanes; l++) begin : gen_slot
    mote_words #(.Seed(Seed), .Stream(Stream + StreamStep * l)) u_words (
        .clk_i, .rst_ni, .advance_i, .word_o(word[l*32+:32]));
    logic [23:0] uniform_q;
    always_ff @(posedge clk_i) uniform_q <= word[l*32+8+:24];
    logic [ProductWidth-1:0] place;
    mote_times #(.AWidth(24), .BWidth(CountWidth), .Product(Product)) u_place (
        .clk_i, .a_i(uniform_q), .b_i(n_i), .p_o(place));
    assign slot[l*SlotWidth+:SlotWidth] = place[24+:SlotWidth];
    lane_t turn;
    assign turn = Choice == 0 || Lanes == 1 ? '0 : Choice == 1 ? word[7-:LaneWidth] : word[l*32+7-:LaneWidth];
    mote_delay #(.Width(LaneWidth), .Depth(1 + Product)) u_from (
        .clk_i, .d_i(Choice == 2 ? turn : LaneWidth'(l) + turn), .d_o(from[l*LaneWidth+:LaneWidth]));
    logic unused_word;
    assign unused_word = ^{word[l*32+:8], place};
  end

  // ---- memories: one a chain, in turn with the lanes; or a copy of all for every lane
  if (Choice == 2) begin : gen_shared
    logic [Lanes*(SlotWidth+1)-1:0] read_slot;
    for (genvar l = 0; l < Lanes; l++) begin : gen_lane
      assign read_slot[l*(SlotWidth+1)+:SlotWidth+1] = {bank_i, slot[l*SlotWidth+:SlotWidth]};
    end
    mote_set #(.Lanes(Lanes), .Width(Width), .SlotWidth(SlotWidth + 1)) u_set (
        .clk_i,
        .write_i,
        .write_slot_i({write_bank_i, write_slot_i}),
        .write_state_i,
        .read_slot_i(read_slot),
        .read_lane_i(from),
        .read_state_o(state_o));
  end else begin : gen_turns
    logic [Lanes*Width-1:0] read;
    for (genvar l = 0; l < Lanes; l++) begin : gen_lane
      lane_t reader, from4;
      logic [SlotWidth-1:0] read_slot;
      assign reader = Lanes == 1 ? '0 : LaneWidth'(l) - from[0+:LaneWidth];
      mote_ram #(.Width(Width), .Words(2 << SlotWidth)) u_set (
          .clk_i,
          .write_i,
          .write_at_i({write_bank_i, write_slot_i}),
          .write_word_i(write_state_i[l*Width+:Width]),
          .read_at_i({bank_i, read_slot}),
          .read_word_o(read[l*Width+:Width]));
      mote_delay #(.Width(SlotWidth), .Depth(Lanes > 1 ? 1 : 0)) u_read_slot (
          .clk_i, .d_i(slot[reader*SlotWidth+:SlotWidth]), .d_o(read_slot));
      mote_delay #(.Width(LaneWidth), .Depth(Lanes > 1 ? 3 : 2)) u_from (.clk_i, .d_i(from[l*LaneWidth+:LaneWidth]), .d_o(from4));
      assign state_o[l*Width+:Width] = read[from4*Width+:Width];
    end
  end
endmodule
