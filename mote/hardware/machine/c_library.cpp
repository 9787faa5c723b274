#include "mote/hardware/machine/c_library.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "mote/base/filled_in.hpp"
#include "mote/hardware/c_call.hpp"
#include "mote/hardware/machine/bits.hpp"
#include "mote/hardware/machine/templates.hpp"

namespace mote::hardware {
namespace {

/// "u_propose.u3table.hex" -> "u_propose_u3table".
std::string table_name(const std::string& file) {
  std::string name = file.substr(0, file.rfind('.'));
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

std::string entry_text(const auto word) {
  return "{UINT64_C(" + std::to_string(static_cast<std::uint64_t>(word)) + "), UINT64_C(" +
         std::to_string(static_cast<std::uint64_t>(word >> 64)) + ")}";
}

/// The tables of an instance.
std::string tables_text(const std::string& instance, const std::vector<Memory>& memories) {
  std::string text;
  for (const Memory& memory : memories) {
    text += "static const mote_entry " + table_name(memory_file(instance, memory)) + "[] = {\n";
    for (const auto word : memory.words) text += "    " + entry_text(word) + ",\n";
    text += "};\n";
  }
  return text;
}

/// And the list of them that a pipeline's function takes.
std::string listed_text(const std::string& instance, const std::vector<Memory>& memories) {
  std::string list;
  for (const Memory& memory : memories) list += (list.empty() ? "" : ", ") + table_name(memory_file(instance, memory));
  return tables_text(instance, memories) + "static const mote_entry *const " + instance + "_tables[] = {" +
         (list.empty() ? "0" : list) + "};\n";
}

/// The functions of a model's pipelines; those that both use once.
std::string functions_text(const ModelCircuit& model) {
  std::string text;
  std::set<std::string> written;
  for (const Circuit* circuit : {&model.propose, &model.weigh})
    for (const Source& source : circuit->sources)
      if (written.insert(source.name).second) text += source.c + "\n";
  return text;
}

const std::string& connected(const ModelCircuit::Connections& connections, const std::string& port) {
  const auto found =
      std::find_if(connections.begin(), connections.end(), [&](const auto& one) { return one.first == port; });
  if (found == connections.end()) throw std::logic_error("port " + port + " is not connected");
  return found->second;
}

/// "bus[7:4]", "bus[4+:4]" or "bus", and the first of its bits.
struct Slice {
  std::string bus;
  int at = 0;
};
Slice slice_of(const std::string& text) {
  const std::size_t bracket = text.find('[');
  if (bracket == std::string::npos) return {text};
  const std::size_t colon = text.find(':', bracket);
  const bool counted = text[colon - 1] == '+';
  return {text.substr(0, bracket), std::stoi(text.substr(counted ? bracket + 1 : colon + 1))};
}

/// What a port is given, of buses of 32-bit words; t is a number.
std::string taken(const Port& port, std::string text) {
  if (const std::size_t literal = text.find("16'd"); literal != std::string::npos) return text.erase(literal, 4);
  const auto [bus, at] = slice_of(text);
  return "mote_take(" + bus + ", " + std::to_string(at) + ", " + std::to_string(port.width) + ", " +
         (port.sign ? "1" : "0") + ")";
}

/// A pipeline called with what its ports are connected to.
std::string call_text(const Circuit& circuit, const std::string& instance,
                      const ModelCircuit::Connections& connections) {
  std::string declared, call = "  " + circuit.module + "(" + instance + "_tables";
  for (const Port& port : circuit.inputs) call += ",\n      " + taken(port, connected(connections, port.name));
  for (const Port& port : circuit.outputs) {
    declared += "  int64_t " + port.name + ";\n";
    call += ", &" + port.name;
  }
  return declared + call + ");\n";
}

std::string stored_text(const Circuit& circuit, const ModelCircuit::Connections& connections) {
  std::string text;
  for (const Port& port : circuit.outputs) {
    const auto [bus, at] = slice_of(connected(connections, port.name));
    text +=
        "  mote_put(" + bus + ", " + std::to_string(at) + ", " + std::to_string(port.width) + ", " + port.name + ");\n";
  }
  return text;
}

std::string enumerators(const Machine& machine) {
  const Capacity& capacity = machine.capacity();
  std::string text;
  std::set<std::string> written;
  const auto append = [&](const std::string& name, const std::string& value) {
    if (written.insert(name).second) text += "  " + name + " = " + value + ",\n";
  };
  for (const Parameter& one : machine.parameters())
    if (one.name != "Seed") append(one.name, c_literal(one.value));
  for (const char* choice : {"Folded", "Overlapped", "CarryWidth"}) append(choice, "0");  // where it has none
  append("Lanes", std::to_string(capacity.lanes));
  append("Most", std::to_string(capacity.most));
  append("Chain", machine.architecture().chain ? "1" : "0");
  append("SlotWidth", std::to_string(capacity.slot_bits()));
  append("StateWords", "(Dims * ValueWidth + 31) / 32");
  return text;
}

std::string register_fields(const Architecture& architecture) {
  std::string text;
  for (const Register& one : architecture.registers)
    text += "  uint32_t " + std::string(one.name) + ";  // " + std::string(one.meaning) + '\n';
  return text;
}

std::string register_values(const Architecture& architecture, const RunRegisters& registers) {
  std::string text;
  for (const Register& one : architecture.registers)
    text += (text.empty() ? "" : ", ") + std::to_string(one.value(registers));
  return text;
}

}  // namespace

std::vector<DesignFile> c_library(const Machine& machine, const RunRegisters& played, const std::string& instance) {
  const ModelCircuit& model = machine.model();
  const Architecture& architecture = machine.architecture();
  const std::string filter(architecture.c_filter);
  const std::string& name = machine.name();
  const std::map<std::string, std::string> places{
      {"name", name},
      {"instance", instance},
      {"model", model.name},
      {"meaning", std::string(architecture.meaning)},
      {"sheet", machine.sheet()},
      {"range", architecture.range(machine.capacity())},
      {"register_fields", register_fields(architecture)},
      {"register_values", register_values(architecture, played)},
      {"observation_words", std::to_string(words_of(machine.observation_bits()))},
      {"estimate_words", std::to_string(words_of(machine.estimate_bits()))},
      {"write_words",
       std::to_string(words_of(machine.particle_bits() + static_cast<int>(machine.capacity().slot_bits())))},
      {"seed", std::to_string(machine.seed())},
      {"sizes", enumerators(machine)},
      {"tables", tables_text("u_filter", machine.filter_tables()) + listed_text("u_propose", model.propose.memories) +
                     listed_text("u_weigh", model.weigh.memories)},
      {"functions", functions_text(model)},
      {"propose", call_text(model.propose, "u_propose", model.propose_connections) +
                      stored_text(model.propose, model.propose_connections)},
      {"weigh", call_text(model.weigh, "u_weigh", model.weigh_connections) + "  return " +
                    model.weigh.outputs.front().name + ";\n"},
      {"filter", filter}};
  const auto filled = [&](const char* file) { return filled_in(machine_template(file), places); };
  const auto copied = [&](const std::string& file) { return DesignFile{file, std::string(machine_template(file))}; };
  std::vector<DesignFile> all{{name + ".h", filled("library.h.in")},
                              {name + ".c", filled("library.c.in")},
                              {"replay.c", filled("replay.c.in")},
                              {"run.sh", filled("replay.sh.in")},
                              copied("operators.h"),
                              copied("filter.h"),
                              copied(filter)};
  if (!architecture.chain) all.push_back(copied("resample.h"));
  return all;
}

}  // namespace mote::hardware
