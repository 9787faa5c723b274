#include "mote/hardware/circuit.hpp"

#include <algorithm>
#include <cctype>

namespace mote::hardware {
namespace {

constexpr const char* kHex = "0123456789abcdef";

std::string list_of(const std::vector<std::pair<std::string, std::string>>& items) {
  std::string text;
  for (const auto& [name, value] : items) text += (text.empty() ? "" : ", ") + ("." + name) + "(" + value + ")";
  return text;
}

}  // namespace

Port port(std::string name, const Format& format) { return {std::move(name), format.width(), format.sign}; }

std::string Memory::text() const {
  const int digits = (width + 3) / 4;
  std::string all;
  for (const auto word : words) {
    for (int digit = digits - 1; digit >= 0; --digit) all += kHex[static_cast<unsigned>(word >> (4 * digit)) & 15U];
    all += '\n';
  }
  return all;
}

Parameter parameter(std::string name, int value) { return {std::move(name), std::to_string(value)}; }

Parameter parameter(std::string name, bool value) { return {std::move(name), value ? "1'b1" : "1'b0"}; }

Parameter parameter(std::string name, int width, std::uint64_t bits) {
  return {std::move(name), std::to_string(width) + "'d" + std::to_string(bits)};
}

void append_format(std::vector<Parameter>& parameters, const std::string& name, const Format& format) {
  parameters.push_back(parameter(name + "Signed", format.sign));
  parameters.push_back(parameter(name + "Width", format.width()));
  parameters.push_back(parameter(name + "Fraction", format.fraction));
}

void append_finish(std::vector<Parameter>& parameters, const Finish& finish) {
  parameters.push_back(parameter("Nearest", finish.rounding == Rounding::kNearest));
  parameters.push_back(parameter("Saturate", finish.overflow == Overflow::kSaturate));
}

std::string memory_file(const std::string& instance, const Memory& memory) {
  std::string name = instance + "." + memory.parameter + ".hex";
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

std::string instantiation(const Circuit& circuit, const std::string& instance, const std::string& folder,
                          const std::vector<std::pair<std::string, std::string>>& connections) {
  std::vector<std::pair<std::string, std::string>> parameters;
  for (const Parameter& one : circuit.parameters) parameters.emplace_back(one.name, one.value);
  for (const Memory& one : circuit.memories)
    parameters.emplace_back(one.parameter, "\"" + folder + memory_file(instance, one) + "\"");
  const std::string given = parameters.empty() ? "" : " #(" + list_of(parameters) + ")";
  return "  " + circuit.module + given + " " + instance + " (" + list_of(connections) + ");\n";
}

}  // namespace mote::hardware
