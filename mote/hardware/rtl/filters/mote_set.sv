// The states of Lanes lanes, a slot each a cycle to write; every lane reads any lane's state.
//
//   read_state_o[l](n) = states[read_lane_i[l](n - 2)] at read_slot_i[l](n - 2)
//
// timing  as mote_ram: latency 2; a copy of the memories for every lane that reads
module mote_set #(
    parameter int unsigned Lanes     = 2,
    parameter int unsigned Width     = 18,
    parameter int unsigned SlotWidth = 10,
    localparam int unsigned LaneWidth = Lanes > 1 ? $clog2(Lanes) : 1
) (
    input  logic                            clk_i,
    input  logic                            write_i,
    input  logic [SlotWidth-1:0]            write_slot_i,
    input  logic [Lanes*Width-1:0]     write_state_i,
    input  logic [Lanes*SlotWidth-1:0] read_slot_i,
    input  logic [Lanes*LaneWidth-1:0] read_lane_i,
    output logic [Lanes*Width-1:0]     read_state_o
);
  for (genvar l = 0; l < Lanes; l++) begin : gen_reader
    logic [Lanes*Width-1:0] read;
    logic [LaneWidth-1:0] from;
    for (genvar m = 0; m < Lanes; m++) begin : gen_memory
      mote_ram #(.Width(Width), .Words(1 << SlotWidth)) u_states (
          .clk_i,
          .write_i,
          .write_at_i(write_slot_i),
          .write_word_i(write_state_i[m*Width+:Width]),
          .read_at_i(read_slot_i[l*SlotWidth+:SlotWidth]),
          .read_word_o(read[m*Width+:Width]));
    end
    mote_delay #(.Width(LaneWidth), .Depth(2)) u_from (.clk_i, .d_i(read_lane_i[l*LaneWidth+:LaneWidth]), .d_o(from));
    assign read_state_o[l*Width+:Width] = read[from*Width+:Width];
  end
endmodule
