#pragma once
// Registers that are plain ports, as the driver uses them; for_registers() is written for the circuit.
#include "request.hpp"

template <class Top>
class Registers {
 public:
  explicit Registers(Top& top) : top_(top) { top_.start_i = 0; }

  template <class Clocks, class Goes>
  bool begin(const mote::hardware::Request& request, Clocks, Goes) {
    const std::uint32_t* word = request.registers;
    for_registers(top_, [&](auto& port) { port = static_cast<std::decay_t<decltype(port)>>(*word++); });
    top_.steps_i = static_cast<SData>(request.steps);
    top_.start_i = 1;
    return true;
  }
  bool cycle(std::uint64_t number) {
    if (number > 0) top_.start_i = 0;
    return true;
  }
  template <class Clocks, class Goes>
  bool end(Clocks, Goes) {
    return true;
  }

 private:
  Top& top_;
};
