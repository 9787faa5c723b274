#include "mote/hardware/timing.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include <nlohmann/json.hpp>

#include "mote/base/refusal.hpp"
#include "mote/hardware/timing_cells.hpp"

namespace mote::hardware {
namespace {

using Json = nlohmann::json;
using Net = int;

/// A bit of a cell's port, and the wire that it is on.
struct Pin {
  std::string port;
  std::size_t bit;
  Net net;
};

struct Cell {
  std::string kind;
  CellParameters parameters;
  std::vector<Pin> inputs, outputs;
};

/// Where a signal arrives latest, and from where.
struct Arrival {
  double ps = -1;
  std::size_t cell = 0;
  Net before = -1;
};

int parameter_value(const Json& value) {
  if (value.is_number_integer()) return value.get<int>();
  if (!value.is_string()) return 0;
  const auto text = value.get<std::string>();
  const bool bits = !text.empty() && text.size() <= 32 && text.find_first_not_of("01") == std::string::npos;
  return bits ? static_cast<int>(std::stoul(text, nullptr, 2)) : 0;
}

Cell cell_from(const Json& json) {
  Cell cell{json["type"].get<std::string>(), {}, {}, {}};
  for (const auto& [name, value] : json["parameters"].items()) cell.parameters[name] = parameter_value(value);
  for (const auto& [port, nets] : json["connections"].items()) {
    auto& pins = json["port_directions"][port] == "output" ? cell.outputs : cell.inputs;
    for (std::size_t bit = 0; bit < nets.size(); ++bit)
      if (nets[bit].is_number()) pins.push_back({port, bit, nets[bit].get<Net>()});
  }
  return cell;
}

/// Arrivals, net by net, each found from those before it.
class Analysis {
 public:
  explicit Analysis(const Json& module) {
    for (const auto& [name, cell] : module["cells"].items()) cells_.push_back(cell_from(cell));
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      for (const Pin& pin : cells_[c].outputs) drivers_[pin.net] = {c, &pin};
    }
  }

  SlowestPath slowest() {
    double latest = 0;
    const Cell* into = nullptr;
    Net from = -1;
    for (const Cell& cell : cells_)
      for (const Pin& pin : cell.inputs) {
        const auto setup = setup_time(cell.kind, cell.parameters, pin.port);
        if (!setup) continue;
        const double arrives = arrival(pin.net).ps;
        if (arrives < 0 || arrives + *setup <= latest) continue;
        latest = arrives + *setup;
        into = &cell;
        from = pin.net;
      }
    std::string path = into == nullptr ? "" : into->kind;
    for (Net net = from; net >= 0; net = arrivals_[net].before) path = cells_[arrivals_[net].cell].kind + " " + path;
    return {latest / 1000, path};
  }

 private:
  const Arrival& arrival(Net net) {
    const auto [found, fresh] = arrivals_.try_emplace(net);
    if (!fresh) return found->second;
    const auto driver = drivers_.find(net);
    if (driver == drivers_.end()) return found->second;  // a port of the module
    const auto [c, out] = driver->second;
    const Cell& cell = cells_[c];
    Arrival latest;
    if (const auto start = arrival_delay(cell.kind, cell.parameters, out->port))
      latest = {static_cast<double>(*start), c, -1};
    for (const Pin& in : cell.inputs) {
      const auto delay = through_delay(cell.kind, cell.parameters, in.port, in.bit, out->port, out->bit);
      if (!delay) continue;
      const double before = arrival(in.net).ps;
      if (before >= 0 && before + *delay > latest.ps) latest = {before + *delay, c, in.net};
    }
    return arrivals_[net] = latest;
  }

  std::vector<Cell> cells_;
  std::map<Net, std::pair<std::size_t, const Pin*>> drivers_;
  std::map<Net, Arrival> arrivals_;
};

/// The only module of a netlist that has cells.
Json module_of(const std::string& json, const std::string& top) {
  const Json netlist = Json::parse(json);
  if (!netlist["modules"].contains(top))
    throw Refusal(ExitCode::kOutsideTool, {"yosys", "", "a netlist of " + top, "none", "Look at its messages."});
  return netlist["modules"][top];
}

}  // namespace

SlowestPath slowest_path(const std::string& json, const std::string& top) {
  return Analysis(module_of(json, top)).slowest();
}

}  // namespace mote::hardware
