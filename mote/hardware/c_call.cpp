#include "mote/hardware/c_call.hpp"

#include <algorithm>

namespace mote::hardware {
namespace {

/// "1'b1" -> "1", "64'd5" -> "UINT64_C(5)", "-3" -> "-3".
std::string c_number(const std::string& value) {
  const std::size_t quote = value.find('\'');
  if (quote == std::string::npos) return value;
  const std::string digits = value.substr(quote + 2);
  return value[quote + 1] == 'b' ? digits : "UINT64_C(" + digits + ")";
}

/// The items of "{c, b, a}", the last first: as the bits of a bus count.
std::string c_array(const std::string& value) {
  std::string items;
  for (std::size_t end = value.size() - 1; end > 0;) {
    const std::size_t before = value.find_last_of("{,", end - 1);
    const std::size_t from = value.find_first_not_of(' ', before + 1);
    items += (items.empty() ? "" : ", ") + c_number(value.substr(from, end - from));
    end = before;
  }
  return "(const int64_t[]){" + items + "}";
}

}  // namespace

std::string c_literal(const std::string& value) { return value.starts_with('{') ? c_array(value) : c_number(value); }

std::string c_call(const Circuit& circuit, std::size_t table, const std::vector<std::string>& in,
                   const std::vector<std::string>& out) {
  std::string lines, arguments;
  for (const std::string& name : out) lines += (lines.empty() ? "  int64_t " : ", ") + name;
  const bool generated = !circuit.sources.empty() && circuit.sources.back().name == circuit.module;
  if (generated) {
    arguments = "tables + " + std::to_string(table);
  } else {
    for (const Parameter& one : circuit.parameters)
      arguments += (arguments.empty() ? "." : ", .") + one.name + " = " + c_literal(one.value);
    for (const Memory& one : circuit.memories)
      arguments += ", ." + one.parameter + " = tables[" + std::to_string(table++) + "]";
    arguments = "&(const " + circuit.module + "_parameters){" + arguments + "}";
  }
  for (const std::string& name : in) arguments += ", " + name;
  for (const std::string& name : out) arguments += ", &" + name;
  lines += ";\n  " + circuit.module + "(" + arguments + ");\n";
  if (generated || circuit.memories.empty()) return lines;
  // a table's words come as bits
  for (std::size_t p = 0; p < out.size(); ++p)
    lines += "  " + out[p] + " = mote_cut((uint64_t)" + out[p] + ", " + (circuit.outputs[p].sign ? "1" : "0") + ", " +
             std::to_string(circuit.outputs[p].width) + ");\n";
  return lines;
}

}  // namespace mote::hardware
