// The scales of a step's weights, for who reads them after it (mote_share): the last one, and which weights it has left so far
// behind that they are nothing.
//
// A rise into an even scale begins an epoch. Slots before the last epoch but one are 3 quanta or more below the last scale; the
// others at most 3.
//
// formats  rise_i: how far the scale rises with this slot, 3 for as much or more and for the first; scale_i: its 3 lowest bits;
//          by_o: 8 scale - 1 + At - zeros_i, modulo 64; mask_o: ones for the lowest zeros_i - At bits
// timing   faint_before_o and level_o stand from the cycle after last_i until the next; by_o and mask_o a cycle after what they
//          are made of
module mote_scales #(
    parameter int unsigned At         = 10,
    parameter int unsigned SlotWidth  = 10,
    parameter int unsigned ZerosWidth = 6
) (
    input  logic                  clk_i,
    input  logic                  write_i,
    input  logic                  last_i,
    input  logic [SlotWidth-1:0]  slot_i,
    input  logic [1:0]            rise_i,
    input  logic [2:0]            scale_i,
    input  logic [ZerosWidth-1:0] zeros_i,        // of the step's sum
    output logic [SlotWidth-1:0]  faint_before_o,  // slots below this one
    output logic [2:0]            level_o,        // scale - 1
    output logic [5:0]            by_o,
    output logic [6:0]            mask_o
);
  logic ends;
  logic [SlotWidth-1:0] epoch_q, older_q, older;
  assign ends = rise_i == 2'd2 || rise_i == 2'd1 && !scale_i[0];
  assign older = rise_i == 2'd3 ? slot_i : ends ? epoch_q : older_q;
  always_ff @(posedge clk_i) begin
    if (write_i) begin
      if (rise_i == 2'd3 || ends) epoch_q <= slot_i;
      older_q <= older;
    end
    if (last_i) begin
      faint_before_o <= older;
      level_o        <= scale_i - 3'd1;
    end
    by_o <= {level_o, 3'b111} + 6'(At) - 6'(zeros_i);
    for (int i = 0; i < 7; i++) mask_o[i] <= 32'(zeros_i) > At + 32'(i);
  end
endmodule
