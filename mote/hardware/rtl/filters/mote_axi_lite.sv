// An AXI4-Lite slave of 32-bit registers: what a run is told, its start and its end.
//
//   0x00      control: writing bit 0 = 1 starts a run; bit 0 reads 1 while one goes on
//   0x04 ...  registers, Count of them, each in a word of its own; read as they were written
//
// A write is taken when its address and its data are both there; bytes by wstrb_i. Registers hold for the runs that
// start later. Answers: OKAY; SLVERR for an address outside the map and for a start while a run goes on: nothing happens then.
//
// timing  a write or read a cycle when its answer is taken at once; start_o is up for the cycle after the write
// source  Arm, AMBA AXI and ACE protocol specification (AXI4-Lite)
module mote_axi_lite #(
    parameter int unsigned Count        = 2,
    parameter int unsigned AddressWidth = 5   // 4 (Count + 1) <= 2^AddressWidth
) (
    input  logic                    clk_i,
    input  logic                    rst_ni,
    // writes
    input  logic [AddressWidth-1:0] awaddr_i,
    input  logic                    awvalid_i,
    output logic                    awready_o,
    input  logic [31:0]             wdata_i,
    input  logic [3:0]              wstrb_i,
    input  logic                    wvalid_i,
    output logic                    wready_o,
    output logic [1:0]              bresp_o,
    output logic                    bvalid_o,
    input  logic                    bready_i,
    // reads
    input  logic [AddressWidth-1:0] araddr_i,
    input  logic                    arvalid_i,
    output logic                    arready_o,
    output logic [31:0]             rdata_o,
    output logic [1:0]              rresp_o,
    output logic                    rvalid_o,
    input  logic                    rready_i,
    // the circuit
    output logic [32*Count-1:0]     registers_o,
    output logic                    start_o,
    input  logic                    busy_i
);
  localparam int unsigned PlaceWidth = AddressWidth - 2;
  localparam logic [1:0] Okay = 2'b00, SlaveError = 2'b10;

  logic [PlaceWidth-1:0] write_place, read_place;
  assign write_place = awaddr_i[AddressWidth-1:2];
  assign read_place  = araddr_i[AddressWidth-1:2];

  // ---- writes
  logic writes, starts, running, write_known;
  assign running = start_o || busy_i;
  assign writes = awvalid_i && wvalid_i && (!bvalid_o || bready_i);
  assign awready_o = writes;
  assign wready_o = writes;
  assign starts = writes && write_place == '0 && wstrb_i[0] && wdata_i[0];
  assign write_known = 32'(write_place) <= Count;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bvalid_o <= 1'b0;
      bresp_o  <= Okay;
      start_o  <= 1'b0;
      registers_o <= '0;
    end else begin
      start_o <= starts && !running;
      if (writes) begin
        bvalid_o <= 1'b1;
        bresp_o  <= write_known && !(starts && running) ? Okay : SlaveError;
        for (int unsigned k = 0; k < Count; k++)
          for (int unsigned b = 0; b < 4; b++)
            if (32'(write_place) == k + 1 && wstrb_i[b]) registers_o[32*k+8*b+:8] <= wdata_i[8*b+:8];
      end else if (bready_i) begin
        bvalid_o <= 1'b0;
      end
    end
  end

  // ---- reads
  logic reads;
  logic [31:0] read_word;
  assign arready_o = !rvalid_o || rready_i;
  assign reads = arvalid_i && arready_o;
  always_comb begin
    read_word = {31'b0, running};
    for (int unsigned k = 0; k < Count; k++)
      if (32'(read_place) == k + 1) read_word = registers_o[32*k+:32];
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rvalid_o <= 1'b0;
      rresp_o  <= Okay;
      rdata_o  <= '0;
    end else if (reads) begin
      rvalid_o <= 1'b1;
      rresp_o  <= 32'(read_place) <= Count ? Okay : SlaveError;
      rdata_o  <= 32'(read_place) <= Count ? read_word : '0;
    end else if (rready_i) begin
      rvalid_o <= 1'b0;
    end
  end
  logic unused_low;
  assign unused_low = ^{awaddr_i[1:0], araddr_i[1:0]};
endmodule
