#pragma once
// Registers on an AXI4-Lite bus, as the driver uses them: written, read back, and a run started by them.
#include "request.hpp"

/// The driver's side of the bus. `goes` says whether a side that may pause goes on; `clocks` brings the next cycle.
template <class Top>
class Registers {
 public:
  explicit Registers(Top& top) : top_(top) {
    top_.s_axi_awvalid_i = top_.s_axi_wvalid_i = top_.s_axi_bready_i = 0;
    top_.s_axi_arvalid_i = top_.s_axi_rready_i = 0;
  }

  /// Writes and reads all registers, and comes to the cycle in which a run starts. Says whether all answers were right.
  template <class Clocks, class Goes>
  bool begin(const mote::hardware::Request& request, Clocks clocks, Goes goes) {
    bool right = read(0, clocks, goes) == 0;
    for (unsigned k = 0; k <= kRegisters; ++k) {
      const std::uint32_t word = k == 0 ? request.steps : request.registers[k - 1];
      right &= write(4 * (k + 1), word, clocks, goes) == kOkay;
    }
    for (unsigned k = 0; k <= kRegisters; ++k)
      right &= read(4 * (k + 1), clocks, goes) == (k == 0 ? request.steps : request.registers[k - 1]);
    if (4 * (kRegisters + 2) < (1U << kAddressBits)) {
      right &= write(4 * (kRegisters + 2), 1, clocks, goes) == kSlaveError;
      read(4 * (kRegisters + 2), clocks, goes);
      right &= read_answer_ == kSlaveError;
    }
    send(0, 1, clocks, goes);
    top_.eval();
    return right && top_.s_axi_bresp_o == kOkay;
  }
  /// In the cycles of a run: another start, which has to be refused. Says whether it was.
  bool cycle(std::uint64_t number) {
    if (number == 0) {
      top_.s_axi_bready_i = top_.s_axi_awvalid_i = top_.s_axi_wvalid_i = 1;
      top_.eval();
      return top_.s_axi_awready_o != 0;
    }
    top_.s_axi_awvalid_i = top_.s_axi_wvalid_i = 0;
    return number > 1 || top_.s_axi_bresp_o == kSlaveError;
  }
  template <class Clocks, class Goes>
  bool end(Clocks clocks, Goes goes) {
    top_.s_axi_bready_i = 0;
    return read(0, clocks, goes) == 0;
  }

 private:
  static constexpr unsigned kOkay = 0, kSlaveError = 2;

  template <class Clocks, class Goes>
  void send(unsigned address, std::uint32_t data, Clocks clocks, Goes goes) {
    top_.s_axi_awaddr_i = address;
    top_.s_axi_wdata_i = data;
    top_.s_axi_wstrb_i = 15;
    for (bool taken = false; !taken; clocks()) {
      top_.s_axi_awvalid_i = top_.s_axi_awvalid_i || goes();
      top_.s_axi_wvalid_i = top_.s_axi_wvalid_i || goes();
      top_.eval();
      taken = top_.s_axi_awready_o && top_.s_axi_wready_o;
    }
    top_.s_axi_awvalid_i = top_.s_axi_wvalid_i = 0;
  }
  template <class Clocks, class Goes>
  unsigned write(unsigned address, std::uint32_t data, Clocks clocks, Goes goes) {
    send(address, data, clocks, goes);
    unsigned answer = 0;
    for (bool taken = false; !taken; clocks()) {
      top_.s_axi_bready_i = goes();
      top_.eval();
      taken = top_.s_axi_bvalid_o && top_.s_axi_bready_i;
      answer = top_.s_axi_bresp_o;
    }
    top_.s_axi_bready_i = 0;
    return answer;
  }
  template <class Clocks, class Goes>
  std::uint32_t read(unsigned address, Clocks clocks, Goes goes) {
    top_.s_axi_araddr_i = address;
    for (bool taken = false; !taken; clocks()) {
      top_.s_axi_arvalid_i = top_.s_axi_arvalid_i || goes();
      top_.eval();
      taken = top_.s_axi_arvalid_i && top_.s_axi_arready_o;
    }
    top_.s_axi_arvalid_i = 0;
    std::uint32_t word = 0;
    for (bool taken = false; !taken; clocks()) {
      top_.s_axi_rready_i = goes();
      top_.eval();
      taken = top_.s_axi_rvalid_o && top_.s_axi_rready_i;
      word = top_.s_axi_rdata_o;
      read_answer_ = top_.s_axi_rresp_o;
    }
    top_.s_axi_rready_i = 0;
    return word;
  }

  Top& top_;
  unsigned read_answer_ = 0;
};
