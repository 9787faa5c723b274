#include "mote/hardware/machine/machine.hpp"

#include <algorithm>

#include "mote/base/filled_in.hpp"
#include "mote/base/refusal.hpp"
#include "mote/hardware/filters/weights.hpp"
#include "mote/hardware/machine/bits.hpp"
#include "mote/hardware/machine/templates.hpp"

namespace mote::hardware {
namespace {

constexpr const char* kFilterInstance = "u_filter";
constexpr const char* kProposeInstance = "u_propose";
constexpr const char* kWeighInstance = "u_weigh";

int whole_bytes(int bits) { return (bits + 7) / 8 * 8; }
int as_int(unsigned number) { return static_cast<int>(number); }
std::string top_bit(int width) { return std::to_string(width - 1); }

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

/// Lines of a data sheet: what stands in a word, and where.
std::string bit_table(const char* heading, const std::vector<Field>& fields) {
  std::string text = std::string("// ") + heading + '\n';
  int at = 0;
  for (const Field& field : fields) {
    const std::string place = std::to_string(at + field.format.width() - 1) + ":" + std::to_string(at);
    text += "//             " + padded(place, 9) + padded(field.format.name(), 8) + field.name + '\n';
    at += field.format.width();
  }
  return text;
}

template <class Table>
Memory table_of(const char* parameter, int width, const Table& table) {
  return {parameter, width, {table.begin(), table.end()}};
}

std::string parameter_lines(std::vector<Parameter> parameters, const std::vector<Memory>& tables,
                            const std::string& folder) {
  for (Parameter& one : parameters)
    if (one.name == "Seed") one.value = "Seed";  // the circuit's own
  for (const Memory& table : tables)
    parameters.push_back({table.parameter, "\"" + folder + memory_file(kFilterInstance, table) + "\""});
  std::string text;
  for (const Parameter& one : parameters)
    text += (text.empty() ? "      ." : ",\n      .") + one.name + "(" + one.value + ")";
  return text;
}

struct RegisterLines {
  std::string ports, connections;
};
RegisterLines register_lines(const Architecture& architecture, const Capacity& capacity) {
  RegisterLines lines;
  for (const Register& one : architecture.registers) {
    const std::string name(one.name);
    const std::string width = one.flag ? "       " : "[" + std::to_string(capacity.at) + ":0] ";
    lines.ports += "    input  logic " + padded(width, 8) + name + "_i,  // " + std::string(one.meaning) + '\n';
    lines.connections += "." + name + "_i(" + name + "_i), ";
  }
  return lines;
}

/// The architecture's registers as words of a bus, steps in the first.
RegisterLines bus_lines(const Architecture& architecture, const Capacity& capacity) {
  RegisterLines lines{"//           0x04     steps, at most 65535\n", ""};
  unsigned word = 1;
  for (const Register& one : architecture.registers) {
    const std::string name(one.name);
    const unsigned at = 32 * word;
    const unsigned top = at + (one.flag ? 0 : capacity.at);
    constexpr const char* kHex = "0123456789abcdef";
    const unsigned address = 4 * ++word;
    lines.ports += std::string("//           0x") + kHex[address / 16 % 16] + kHex[address % 16] + "     " + name +
                   ": " + std::string(one.meaning) + '\n';
    lines.connections += "." + name + "_i(registers[" + std::to_string(top) + ":" + std::to_string(at) + "]), ";
  }
  return lines;
}

/// The parts of an estimate: their wires, what leads to them, and how they stand together.
struct EstimateLines {
  std::string wires, connections, together;
};
EstimateLines estimate_lines(const Architecture& architecture, const Formats& f, const Capacity& capacity) {
  EstimateLines lines;
  const auto part = [&](const std::string& name, unsigned width) {
    lines.wires += "  logic [" + top_bit(as_int(width)) + ":0] " + name + ";\n";
    lines.connections += (lines.connections.empty() ? "." : ", .") + ("est_" + name) + "_o(" + name + ")";
    lines.together = name + (lines.together.empty() ? "" : ", " + lines.together);
  };
  part("mean", f.dims * (f.value_bits + f.extra_bits + 1));
  part("sum", f.weight_bits + capacity.at);
  part("scale", f.log_bits - 12);
  if (architecture.chain) part("accepted", capacity.at + 1);
  return lines;
}

/// The sums of weighted values have to stay within 64 bits of the golden model.
void refuse_wide_sums(const ModelCircuit& model, const Capacity& capacity) {
  const Formats& f = model.arithmetic.formats;
  const unsigned most = 63 - f.weight_bits - capacity.at;
  if (f.value_bits <= most) return;
  std::string states;
  for (const Field& state : model.states)
    states += (states.empty() ? "" : ", ") + state.name + ' ' + state.format.name();
  throw Refusal(ExitCode::kWrongUse,
                {"circuit", "states of " + model.name,
                 "words of at most " + std::to_string(most) + " bits for up to " + std::to_string(1U << capacity.at) +
                     " particles or proposals",
                 std::to_string(f.value_bits) + " (" + states + ")",
                 "Write a state that is far from 0 beside its noise as the difference to a constant, or pass a smaller "
                 "--particles."});
}

}  // namespace

Machine::Machine(ModelCircuit model, const Architecture& architecture, const RunRegisters& most, std::uint64_t seed,
                 unsigned lanes, const Variant& variant, RegisterAccess access)
    : name_("mote_" + model.name + "_" + std::string(architecture.name)),
      model_(std::move(model)),
      architecture_(&architecture),
      capacity_(architecture.capacity(most, lanes)),
      seed_(seed),
      access_(access) {
  capacity_.variant = variant;
  std::replace(name_.begin(), name_.end(), '-', '_');
  refuse_wide_sums(model_, capacity_);
}

unsigned Machine::stages() const {
  const ImhLanes lanes = architecture_->fed(capacity_);
  const auto more = static_cast<unsigned>(lanes.turn_latency() + lanes.chain_latency() - 1);
  return architecture_->stages + formats().propose_latency + formats().weigh_latency +
         (architecture_->chain ? formats().product_latency - 1 + more : 0);
}

int Machine::particle_bits() const { return as_int(capacity_.lanes * formats().dims * formats().value_bits); }

int Machine::observation_bits() const { return whole_bytes(model_.observed_bits()); }

int Machine::estimate_bits() const {
  int bits = 0;
  for (const Field& field : estimate_fields()) bits += field.format.width();
  return whole_bytes(bits);
}

std::vector<Field> Machine::estimate_fields() const {
  const Formats& f = formats();
  const int mean_bits = as_int(f.value_bits + f.extra_bits);
  std::vector<Field> fields;
  for (const Field& state : model_.states) {
    const int fraction = state.format.fraction + as_int(f.extra_bits);
    fields.push_back({"mean of " + state.name, {true, mean_bits - fraction, fraction}});
  }
  fields.push_back({"sum of weights", {false, as_int(capacity_.at), as_int(f.weight_bits)}});
  fields.push_back({"scale of the sum, quanta of 8 octaves", {true, as_int(f.log_bits) - 13, 0}});
  if (architecture_->chain) fields.push_back({"moves of the chain", {false, as_int(capacity_.at) + 1, 0}});
  return fields;
}

std::vector<Port> Machine::inputs() const {
  std::vector<Port> ports;
  if (access_ == RegisterAccess::kAxiLite) {
    const int address = address_bits();
    ports = {{"s_axi_awaddr_i", address}, {"s_axi_awvalid_i"}, {"s_axi_wdata_i", 32},
             {"s_axi_wstrb_i", 4},        {"s_axi_wvalid_i"},  {"s_axi_bready_i"},
             {"s_axi_araddr_i", address}, {"s_axi_arvalid_i"}, {"s_axi_rready_i"}};
  } else {
    ports = {{"start_i"}, {"steps_i", 16}};
    for (const Register& one : architecture_->registers)
      ports.push_back({std::string(one.name) + "_i", one.flag ? 1 : as_int(capacity_.at) + 1});
  }
  for (const Port& port : {Port{"obs_tdata_i", observation_bits()}, Port{"obs_tvalid_i"}, Port{"est_tready_i"}})
    ports.push_back(port);
  return ports;
}

std::vector<Port> Machine::outputs() const {
  std::vector<Port> ports{{"busy_o"}};
  if (access_ == RegisterAccess::kAxiLite)
    ports = {{"s_axi_awready_o"}, {"s_axi_wready_o"},    {"s_axi_bresp_o", 2}, {"s_axi_bvalid_o"},
             {"s_axi_arready_o"}, {"s_axi_rdata_o", 32}, {"s_axi_rresp_o", 2}, {"s_axi_rvalid_o"}};
  for (const Port& port :
       {Port{"obs_tready_o"}, Port{"est_tdata_o", estimate_bits()}, Port{"est_tvalid_o"}, Port{"est_tlast_o"},
        Port{"set_valid_o"}, Port{"set_slot_o", as_int(capacity_.slot_bits())}, Port{"set_state_o", particle_bits()}})
    ports.push_back(port);
  return ports;
}

int Machine::pins() const {
  int pins = 2;  // clock and reset
  for (const auto& ports : {inputs(), outputs()})
    for (const Port& port : ports) pins += port.width;
  return pins;
}

std::vector<std::uint32_t> Machine::observation_words(Observed observed) const {
  BitWriter bits(observation_bits());
  for (std::size_t k = 0; k < model_.observed.size(); ++k) bits.append(observed[k], model_.observed[k].format.width());
  return bits.words();
}

Estimate Machine::estimate_in(const std::uint32_t* words) const {
  const Formats& f = formats();
  BitReader bits(words);
  Estimate estimate;
  for (unsigned d = 0; d < f.dims; ++d)
    estimate.mean.push_back(bits.take_signed(as_int(f.value_bits + f.extra_bits + 1)));
  estimate.sum = bits.take(as_int(f.weight_bits + capacity_.at));
  estimate.scale = bits.take_signed(as_int(f.log_bits) - 12);
  if (architecture_->chain) estimate.accepted = bits.take(as_int(capacity_.at) + 1);
  return estimate;
}

std::vector<Parameter> Machine::parameters() const {
  const Formats& f = formats();
  std::vector<Parameter> all{parameter("Dims", as_int(f.dims)),
                             parameter("ValueWidth", as_int(f.value_bits)),
                             parameter("ObsWidth", model_.observed_bits()),
                             parameter("DrawWords", as_int(f.draw_words)),
                             parameter("LogWidth", as_int(f.log_bits)),
                             parameter("WeightWidth", as_int(f.weight_bits)),
                             parameter("Extra", as_int(f.extra_bits)),
                             parameter("At", as_int(capacity_.at)),
                             parameter("ProposeLatency", as_int(f.propose_latency)),
                             parameter("WeighLatency", as_int(f.weigh_latency)),
                             parameter("Product", as_int(f.product_latency)),
                             parameter("Seed", 64, seed_)};
  if (f.interval > 1) all.push_back(parameter("Interval", as_int(f.interval)));
  if (capacity_.variant.logic_tables) all.push_back(parameter("TableLogic", true));
  if (f.carried > 0) all.push_back(parameter("CarryWidth", as_int(f.carried * f.value_bits)));
  for (const Parameter& one : architecture_->parameters(capacity_)) all.push_back(one);
  return all;
}

std::vector<Memory> Machine::filter_tables() const {
  std::vector<Memory> all{table_of("Exp2Table", kMantissaBits, exp2_table())};
  if (architecture_->chain) all.push_back(table_of("Log2Table", 8, log2_table()));
  return all;
}

std::string Machine::sheet() const {
  std::vector<Field> particle;
  for (unsigned lane = 0; lane < capacity_.lanes; ++lane)
    for (const Field& state : model_.states)
      particle.push_back(
          {capacity_.lanes == 1 ? state.name : state.name + ", lane " + std::to_string(lane), state.format});
  return bit_table("formats   observation, obs_tdata_i", model_.observed) +
         bit_table("          estimate, est_tdata_o", estimate_fields()) +
         bit_table("          particle, set_state_o", particle);
}

std::string Machine::top(const std::string& folder) const {
  const Formats& f = formats();
  const RegisterLines registers = register_lines(*architecture_, capacity_);
  const EstimateLines estimate = estimate_lines(*architecture_, f, capacity_);
  return filled_in(machine_template("filter.sv.in"),
                   {{"name", name_},
                    {"model", model_.name},
                    {"meaning", std::string(architecture_->meaning)},
                    {"module", std::string(architecture_->module)},
                    {"golden", std::string(architecture_->golden_file)},
                    {"propose_module", model_.propose.module},
                    {"weigh_module", model_.weigh.module},
                    {"propose_latency", std::to_string(f.propose_latency)},
                    {"weigh_latency", std::to_string(f.weigh_latency)},
                    {"sheet", sheet()},
                    {"range", architecture_->range(capacity_)},
                    {"stages", std::to_string(stages())},
                    {"seed", std::to_string(seed_)},
                    {"register_ports", registers.ports},
                    {"register_connections", registers.connections},
                    {"obs_top", top_bit(observation_bits())},
                    {"observed_top", top_bit(model_.observed_bits())},
                    {"est_top", top_bit(estimate_bits())},
                    {"est_width", std::to_string(estimate_bits())},
                    {"slot_top", top_bit(as_int(capacity_.slot_bits()))},
                    {"state_top", top_bit(particle_bits())},
                    {"lanes", std::to_string(capacity_.lanes)},
                    {"state_width", std::to_string(f.dims * f.value_bits)},
                    {"pair_width", std::to_string((f.dims + f.carried) * f.value_bits)},
                    {"draw_words", std::to_string(f.draw_words)},
                    {"log_width", std::to_string(f.log_bits)},
                    {"weigh_obs", architecture_->chain ? "" : "  assign weigh_obs = obs;\n"},
                    {"weigh_obs_connection", architecture_->chain ? ".weigh_obs_o(weigh_obs), " : ""},
                    {"estimate_wires", estimate.wires},
                    {"estimate_connections", estimate.connections},
                    {"estimate", estimate.together},
                    {"parameters", parameter_lines(parameters(), filter_tables(), folder)},
                    {"propose", instantiation(model_.propose, kProposeInstance, folder, model_.propose_connections)},
                    {"weigh", instantiation(model_.weigh, kWeighInstance, folder, model_.weigh_connections)}});
}

std::string Machine::axi_lite() const {
  const RegisterLines bus = bus_lines(*architecture_, capacity_);
  const int count = 1 + static_cast<int>(architecture_->registers.size());
  return filled_in(machine_template("axi_lite.sv.in"), {{"name", top_name()},
                                                        {"circuit", name_},
                                                        {"map", bus.ports},
                                                        {"connections", bus.connections},
                                                        {"count", std::to_string(count)},
                                                        {"address_width", std::to_string(address_bits())},
                                                        {"address_top", top_bit(address_bits())},
                                                        {"registers_top", top_bit(32 * count)},
                                                        {"obs_top", top_bit(observation_bits())},
                                                        {"est_top", top_bit(estimate_bits())},
                                                        {"slot_top", top_bit(as_int(capacity_.slot_bits()))},
                                                        {"state_top", top_bit(particle_bits())}});
}

std::vector<DesignFile> Machine::modules(const std::string& folder) const {
  std::vector<DesignFile> own;
  for (const Circuit* circuit : {&model_.propose, &model_.weigh})
    for (const Source& source : circuit->sources) own.push_back({source.name + ".sv", source.text});
  own.push_back({name_ + ".sv", top(folder)});
  if (access_ == RegisterAccess::kAxiLite) own.push_back({top_name() + ".sv", axi_lite()});
  std::string text;
  for (const DesignFile& file : own) text += file.text;
  std::vector<DesignFile> all;
  for (const RtlFile& file : needed_of_library(text)) all.push_back({std::string(file.name), std::string(file.text)});
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

std::vector<DesignFile> Machine::tables() const {
  std::vector<DesignFile> all;
  const auto append = [&](const char* instance, const std::vector<Memory>& memories) {
    for (const Memory& memory : memories) all.push_back({memory_file(instance, memory), memory.text()});
  };
  append(kFilterInstance, filter_tables());
  append(kProposeInstance, model_.propose.memories);
  append(kWeighInstance, model_.weigh.memories);
  return all;
}

std::string Machine::text() const {
  std::string text;
  for (const auto& files : {modules(""), tables()})
    for (const DesignFile& file : files) text += file.name + '\n' + file.text;
  return text;
}

}  // namespace mote::hardware
