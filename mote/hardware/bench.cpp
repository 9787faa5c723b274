#include "mote/hardware/bench.hpp"

#include <algorithm>

#include <dlfcn.h>

#include "mote/base/refusal.hpp"
#include "mote/hardware/rtl_library.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {
namespace {

std::string name_of(char kind, std::size_t circuit, std::size_t port) {
  return kind + std::to_string(circuit) + "_" + std::to_string(port);
}

std::string enters_of(std::size_t circuit) { return "enters" + std::to_string(circuit); }

std::string declaration(const char* direction, const std::string& name, int width) {
  return ",\n    " + std::string(direction) + " logic [" + std::to_string(width - 1) + ":0] " + name;
}

using Connections = std::vector<std::pair<std::string, std::string>>;

Connections connections_of(const Circuit& circuit, std::size_t c) {
  Connections connections{{"clk_i", "clk_i"}};
  if (circuit.reset) connections.emplace_back("rst_ni", "rst_ni");
  if (circuit.interval > 1) connections.emplace_back("enters_i", enters_of(c));
  for (std::size_t p = 0; p < circuit.inputs.size(); ++p)
    connections.emplace_back(circuit.inputs[p].name, name_of('i', c, p));
  for (std::size_t p = 0; p < circuit.outputs.size(); ++p)
    connections.emplace_back(circuit.outputs[p].name, name_of('o', c, p));
  return connections;
}

/// The lines of the driver for one kind of port: `line(name, width, signed, column)`.
template <class Line>
std::string for_ports(const std::vector<Circuit>& circuits, char kind, Line line) {
  std::string text;
  int column = 0;
  for (std::size_t c = 0; c < circuits.size(); ++c) {
    const auto& ports = kind == 'i' ? circuits[c].inputs : circuits[c].outputs;
    for (std::size_t p = 0; p < ports.size(); ++p)
      text += line(name_of(kind, c, p), ports[p].width, ports[p].sign, std::to_string(column++));
  }
  return text;
}

std::string driven(const std::string& name, int width, bool, const std::string& column) {
  const std::string mask = "(~0ULL >> " + std::to_string(64 - width) + ")";
  return "    top." + name + " = static_cast<std::decay_t<decltype(top." + name + ")>>(in[" + column + "][t] & " +
         mask + ");\n";
}

std::string read(const std::string& name, int width, bool sign, const std::string& column) {
  const std::string unused = std::to_string(64 - width);
  const std::string type = sign ? "std::int64_t" : "std::uint64_t";
  return "    out[" + column + "][t] = static_cast<std::int64_t>(static_cast<" + type +
         ">(static_cast<std::uint64_t>(top." + name + ") << " + unused + ") >> " + unused + ");\n";
}

/// Says when a row goes into circuits that take one every few clocks.
std::string entering(const std::vector<Circuit>& circuits) {
  std::string text;
  for (std::size_t c = 0; c < circuits.size(); ++c)
    if (circuits[c].interval > 1)
      text += "    top." + enters_of(c) + " = t % " + std::to_string(circuits[c].interval) + " == 0;\n";
  return text;
}

/// The C++ around the simulated design: a reset, then a row a clock.
std::string driver(const std::vector<Circuit>& circuits) {
  return R"(#include <cstddef>
#include <cstdint>
#include <type_traits>
#include "Vbench.h"
#include "verilated.h"
extern "C" void run(const std::int64_t* const* in, std::int64_t* const* out, std::size_t rows) {
  VerilatedContext context;
  Vbench top{&context};
  top.clk_i = 0;
  top.rst_ni = 0;
  for (int edge = 0; edge < 16; ++edge) {
    top.eval();
    top.clk_i = !top.clk_i;
  }
  top.rst_ni = 1;
  for (std::size_t t = 0; t < rows; ++t) {
    top.clk_i = 0;
)" + for_ports(circuits, 'i', driven) +
         entering(circuits) + "    top.eval();\n    top.clk_i = 1;\n    top.eval();\n" +
         for_ports(circuits, 'o', read) + "  }\n}\n";
}

/// A column as it is driven: a word every few clocks, other bits between unless it stands; the last until the slowest
/// circuit has answered.
std::vector<Word> driven_column(const std::vector<Word>& column, std::size_t interval, std::size_t clocks) {
  std::vector<Word> longer(clocks, column.back());
  for (std::size_t row = 0; row + 1 < column.size(); ++row) {
    const bool stands = column[row] == column[row + 1];
    std::fill_n(longer.begin() + static_cast<std::ptrdiff_t>(row * interval), interval,
                stands ? column[row] : ~column[row]);
    longer[row * interval] = column[row];
  }
  return longer;
}

}  // namespace

std::string bench_module(const std::string& name, const std::vector<Circuit>& circuits, const std::string& folder) {
  const auto ports = [&](char kind, const char* direction) {
    return for_ports(circuits, kind, [&](const std::string& port, int width, bool, const std::string&) {
      return declaration(direction, port, width);
    });
  };
  std::string text = "module " + name + " (\n    input logic clk_i,\n    input logic rst_ni" + ports('i', "input");
  for (std::size_t c = 0; c < circuits.size(); ++c)
    if (circuits[c].interval > 1) text += ",\n    input logic " + enters_of(c);
  text += ports('o', "output") + "\n);\n";
  for (std::size_t c = 0; c < circuits.size(); ++c)
    text += instantiation(circuits[c], "u" + std::to_string(c), folder, connections_of(circuits[c], c));
  return text + "  logic unused_reset;\n  assign unused_reset = rst_ni;\nendmodule\n";
}

void write_bench(const std::string& folder, const std::string& name, const std::vector<Circuit>& circuits) {
  std::string texts = bench_module(name, circuits, folder);
  write_text(folder + name + ".sv", texts);
  for (const Circuit& circuit : circuits)
    for (const Source& source : circuit.sources) texts += source.text;
  for (const RtlFile& file : needed_of_library(texts))
    write_text(folder + std::string(file.name), std::string(file.text));
  for (std::size_t c = 0; c < circuits.size(); ++c) {
    for (const Source& source : circuits[c].sources) write_text(folder + source.name + ".sv", source.text);
    for (const Memory& memory : circuits[c].memories)
      write_text(folder + memory_file("u" + std::to_string(c), memory), memory.text());
  }
}

Bench::Bench(std::vector<Circuit> circuits) : circuits_(std::move(circuits)) { build(); }

Bench::~Bench() {
  if (library_ != nullptr) dlclose(library_);
}

void Bench::build() {
  const std::string folder = folder_.path().string() + "/";
  write_bench(folder, "bench", circuits_);
  write_text(folder + "driver.cpp", driver(circuits_));
  std::string make = "OPT_FAST=-O1 OPT_SLOW=-O0 OPT_GLOBAL=-O1";
  if (on_path("ccache")) make += " OBJCACHE=ccache";
  run_tool("verilator", "verilator",
           {"--cc",
            "--exe",
            "--build",
            "-Wall",
            "-O3",
            "--top-module",
            "bench",
            "--Mdir",
            folder + "model",
            "-y",
            folder,
            "-CFLAGS",
            "-fPIC",
            "-LDFLAGS",
            "-shared",
            "-MAKEFLAGS",
            make,
            "-o",
            "bench.so",
            folder + "bench.sv",
            folder + "driver.cpp"});
  library_ = dlopen((folder + "model/bench.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr)
    throw Refusal(ExitCode::kOutsideTool, {"verilator", "", "a library that loads", dlerror(), "Reinstall verilator."});
  run_ = reinterpret_cast<decltype(run_)>(dlsym(library_, "run"));
}

std::vector<Table> Bench::run(const std::vector<Table>& inputs, std::size_t rows) {
  int slowest = 1;
  std::size_t longest = 1;
  for (const Circuit& circuit : circuits_) {
    slowest = std::max(slowest, circuit.latency);
    longest = std::max(longest, static_cast<std::size_t>(circuit.interval));
  }
  const std::size_t clocks = rows * longest + static_cast<std::size_t>(slowest);
  std::vector<std::vector<Word>> in;
  std::vector<std::vector<Word>> out;
  for (std::size_t c = 0; c < circuits_.size(); ++c) {
    const auto interval = static_cast<std::size_t>(circuits_[c].interval);
    for (const auto& column : inputs[c]) in.push_back(driven_column(column, interval, clocks));
    out.resize(out.size() + circuits_[c].outputs.size(), std::vector<Word>(clocks));
  }
  std::vector<const Word*> from;
  std::vector<Word*> into;
  for (const auto& column : in) from.push_back(column.data());
  for (auto& column : out) into.push_back(column.data());
  run_(from.data(), into.data(), clocks);

  std::vector<Table> answers(circuits_.size());
  auto next = out.begin();
  for (std::size_t c = 0; c < circuits_.size(); ++c)
    for (std::size_t p = 0; p < circuits_[c].outputs.size(); ++p, ++next) {
      auto answer = next->begin() + std::max(0, circuits_[c].latency - 1);
      std::vector<Word>& column = answers[c].emplace_back(rows);
      for (std::size_t t = 0; t < rows; ++t, answer += circuits_[c].interval) column[t] = *answer;
    }
  return answers;
}

}  // namespace mote::hardware
