#include "mote/hardware/timing_cells.hpp"

#include <algorithm>
#include <array>

namespace mote::hardware {
namespace {

/// Of a look-up table's inputs: the last one is the fastest.
constexpr std::array<int, 6> kLut{642, 631, 472, 407, 238, 127};

/// CARRY4: sources CYINIT, CI, DI0..3, S0..3; sinks O0..3, CO0..3; 0 where no signal goes through.
constexpr std::array<std::array<int, 8>, 10> kCarry{{{482, 598, 584, 642, 536, 494, 592, 580},
                                                     {222, 334, 239, 313, 271, 157, 228, 114},
                                                     {0, 407, 556, 615, 379, 465, 540, 526},
                                                     {0, 0, 537, 596, 0, 445, 520, 507},
                                                     {0, 0, 0, 438, 0, 0, 356, 398},
                                                     {0, 0, 0, 0, 0, 0, 0, 385},
                                                     {223, 400, 523, 582, 340, 433, 512, 508},
                                                     {0, 205, 558, 618, 0, 469, 548, 528},
                                                     {0, 0, 226, 330, 0, 0, 292, 378},
                                                     {0, 0, 0, 227, 0, 0, 0, 380}}};

bool is_lut_memory(const std::string& kind) { return kind.starts_with("RAM") && !kind.starts_with("RAMB"); }
bool is_shift(const std::string& kind) { return kind.starts_with("SRL"); }
bool is_flip_flop(const std::string& kind) { return kind.starts_with("FD"); }
bool is_block_memory(const std::string& kind) { return kind.starts_with("RAMB"); }

int value(const CellParameters& parameters, const std::string& name) {
  const auto found = parameters.find(name);
  return found == parameters.end() ? 0 : found->second;
}

/// The number at the end of a name: I3 -> 3, DPRA4 -> 4; the bit of a bus where there is none.
std::size_t place(const std::string& port, std::size_t bit) {
  const auto digit = port.find_first_of("0123456789");
  return digit == std::string::npos ? bit : static_cast<std::size_t>(std::stoi(port.substr(digit)));
}

std::optional<int> carry_delay(const std::string& input, std::size_t input_bit, const std::string& output,
                               std::size_t output_bit) {
  const std::size_t source = input == "CYINIT" ? 0 : input == "CI" ? 1 : input == "DI" ? 2 + input_bit : 6 + input_bit;
  const int delay = kCarry[source][output == "O" ? output_bit : 4 + output_bit];
  return delay == 0 ? std::nullopt : std::optional(delay);
}

bool has_mid_register(const CellParameters& p) { return value(p, "MREG") != 0 || value(p, "PREG") != 0; }

std::optional<int> dsp_through(const CellParameters& p, const std::string& input) {
  if (input == "PCIN" && value(p, "PREG") == 0) return 1255;
  if (input == "A" && value(p, "AREG") == 0 && !has_mid_register(p)) return 2970;
  if (input == "B" && value(p, "BREG") == 0 && !has_mid_register(p)) return 2838;
  if (input == "C" && value(p, "CREG") == 0 && value(p, "PREG") == 0) return 1474;
  return std::nullopt;
}

std::optional<int> dsp_arrival(const CellParameters& p, bool cascade) {
  const int more = cascade ? 148 : 0;
  if (value(p, "PREG") != 0) return cascade ? 435 : 329;
  if (value(p, "MREG") != 0 || value(p, "CREG") != 0) return 1687 + more;
  if (value(p, "AREG") != 0 || value(p, "BREG") != 0) return 2952 + more;
  return std::nullopt;
}

std::optional<int> dsp_setup(const CellParameters& p, const std::string& input) {
  const bool middle = value(p, "MREG") != 0;
  const bool last = value(p, "PREG") != 0;
  if (input == "A")
    return value(p, "AREG") != 0 ? std::optional(254) : middle ? 1416 : last ? 2739 : std::optional<int>();
  if (input == "B")
    return value(p, "BREG") != 0 ? std::optional(324) : middle ? 1285 : last ? 2608 : std::optional<int>();
  if (input == "C") return value(p, "CREG") != 0 ? std::optional(168) : last ? std::optional(1244) : std::nullopt;
  if (input == "PCIN" && last) return 1025;
  return std::nullopt;
}

}  // namespace

std::optional<int> through_delay(const std::string& kind, const CellParameters& parameters, const std::string& input,
                                 std::size_t input_bit, const std::string& output, std::size_t output_bit) {
  if (kind == "INV") return 127;
  if (kind.starts_with("LUT")) return kLut[6 - place(kind, 0) + place(input, input_bit)];
  if (kind == "CARRY4") return carry_delay(input, input_bit, output, output_bit);
  if (kind == "MUXF7") return input == "S" ? 296 : input == "I1" ? 223 : 217;
  if (kind == "MUXF8") return input == "S" ? 273 : 104;
  if (is_shift(kind) && input.starts_with("A") && output == "Q")
    return kLut[std::min<std::size_t>(place(input, input_bit), 5)];
  if (is_lut_memory(kind) && (input.starts_with("A") || input.starts_with("DPRA")))
    return kLut[std::min<std::size_t>(place(input, input_bit), 5)];
  if (kind == "DSP48E1") return dsp_through(parameters, input);
  return std::nullopt;
}

std::optional<int> arrival_delay(const std::string& kind, const CellParameters& parameters, const std::string& output) {
  if (is_flip_flop(kind)) return 303;
  if (is_shift(kind)) return output == "Q31" ? 1114 : 1472;
  if (is_lut_memory(kind)) return 1190;
  if (is_block_memory(kind))
    return value(parameters, output.starts_with("DOA") ? "DOA_REG" : "DOB_REG") != 0 ? 882 : 2454;
  if (kind == "DSP48E1") return dsp_arrival(parameters, output == "PCOUT");
  return std::nullopt;
}

std::optional<int> setup_time(const std::string& kind, const CellParameters& parameters, const std::string& input) {
  if (is_flip_flop(kind)) return input == "D" ? 0 : input == "CE" ? 109 : 404;
  if (is_shift(kind)) return input == "D" ? std::optional(173) : input == "CE" ? std::optional(109) : std::nullopt;
  if (is_lut_memory(kind))
    return input == "WE" ? 654 : input.starts_with("D") && !input.starts_with("DPRA") ? 461 : 362;
  if (is_block_memory(kind))
    return input.find("ADDR") != std::string::npos ? 566
           : input.starts_with("WE")               ? 532
           : input.starts_with("DI")               ? 737
                                                   : 443;
  if (kind == "DSP48E1") return dsp_setup(parameters, input);
  return std::nullopt;
}

}  // namespace mote::hardware
