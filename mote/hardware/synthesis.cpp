#include "mote/hardware/synthesis.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"
#include "mote/hardware/bench.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {
namespace {

/// Every register with an asynchronous reset has an inverter of its own before this.
constexpr const char* kMergeEqualCells = "opt_merge -share_all; opt_clean";

/// The number of cells of each kind in what `stat` printed last.
std::map<std::string, int> cells_of(const std::string& printed) {
  std::istringstream lines(printed.substr(std::min(printed.size(), printed.rfind("Number of cells:"))));
  std::map<std::string, int> cells;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    int count = 0;
    if (words >> kind >> count) cells[kind] = count;
  }
  return cells;
}

/// LUT-RAM and shift registers as the look-up tables that they occupy.
int memory_luts(const std::map<std::string, int>& cells) {
  static const std::map<std::string, int> sizes{{"SRL16E", 1},    {"SRLC16E", 1},  {"SRLC32E", 1},  {"RAM32X1S", 1},
                                                {"RAM64X1S", 1},  {"RAM32X1D", 2}, {"RAM64X1D", 2}, {"RAM128X1S", 2},
                                                {"RAM128X1D", 4}, {"RAM32M", 4},   {"RAM64M", 4},   {"RAM256X1S", 4}};
  int sum = 0;
  for (const auto& [kind, luts] : sizes)
    if (const auto found = cells.find(kind); found != cells.end()) sum += luts * found->second;
  return sum;
}

/// Shift registers around a circuit, so that its ports need two pins: a chain of input bits, and a parity of registered
/// outputs.
std::string surroundings(const Circuit& circuit) {
  std::string ports;
  int in = 0;
  int out = 0;
  for (std::size_t p = 0; p < circuit.inputs.size(); ++p) {
    ports += ", .i0_" + std::to_string(p) + "(in_q[" + std::to_string(in) +
             " +: " + std::to_string(circuit.inputs[p].width) + "])";
    in += circuit.inputs[p].width;
  }
  for (std::size_t p = 0; p < circuit.outputs.size(); ++p) {
    ports += ", .o0_" + std::to_string(p) + "(out[" + std::to_string(out) +
             " +: " + std::to_string(circuit.outputs[p].width) + "])";
    out += circuit.outputs[p].width;
  }
  const std::string in_top = std::to_string(std::max(0, in - 1));
  const std::string out_top = std::to_string(out - 1);
  const std::string shifted = in > 1 ? "{in_q[" + std::to_string(in - 2) + ":0], bit_i}" : "bit_i";
  return "module around (input logic clk_i, input logic rst_ni, input logic bit_i, output logic bit_o);\n"
         "  logic [" +
         in_top + ":0] in_q;\n  logic [" + out_top +
         ":0] out, out_q, chain_q;\n"
         "  core core_u (.clk_i(clk_i), .rst_ni(rst_ni)" +
         ports +
         ");\n"
         "  always_ff @(posedge clk_i) begin\n    in_q <= " +
         shifted +
         ";\n    out_q <= out;\n"
         "    chain_q <= {chain_q, 1'b0} ^ out_q;\n    bit_o <= chain_q[" +
         out_top + "];\n  end\nendmodule\n";
}

double clock_of(const std::string& router, const std::string& log) {
  const std::string key = "Max frequency for clock";
  const auto line = log.rfind(key);
  const auto colon = log.find("': ", line);
  if (line == std::string::npos || colon == std::string::npos)
    throw Refusal(ExitCode::kOutsideTool, {router, "", "a clock rate", "none", "Look at its messages."});
  return std::stod(log.substr(colon + 3));
}

/// A device family: how it is synthesised for, and by what it is routed.
struct Router {
  const char* synthesis;
  const char* look_up;  ///< the kind of its look-up tables
  std::string program;
  std::vector<std::string> device;
};

Routed routed(Circuit circuit, const Router& router, int seed) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  if (std::exchange(circuit.interval, 1) > 1) circuit.inputs.push_back({"enters_i"});  // comes as any other bit
  write_bench(folder, "core", {circuit});
  write_text(folder + "around.sv", surroundings(circuit));
  const auto cells =
      cells_after(folder, std::string(router.synthesis) + " -top around -json " + folder + "netlist.json");
  std::vector<std::string> words = router.device;
  for (const std::string& word : {std::string("--seed"), std::to_string(seed), std::string("--freq"),
                                  std::string("150"), std::string("--timing-allow-fail"), std::string("--json"),
                                  folder + "netlist.json", std::string("--log"), folder + "log.txt", std::string("-q")})
    words.push_back(word);
  run_tool(router.program, router.program, words);
  return {total(cells, {router.look_up}), clock_of(router.program, read_text(folder + "log.txt"))};
}

}  // namespace

int total(const std::map<std::string, int>& cells, const std::vector<std::string>& beginnings) {
  int sum = 0;
  for (const auto& [kind, count] : cells)
    for (const std::string& beginning : beginnings)
      if (kind.starts_with(beginning)) sum += count;
  return sum;
}

std::map<std::string, int> cells_after(const std::string& folder, const std::string& script) {
  run_tool("yosys", "yosys",
           {"-q", "-p",
            "read_verilog -sv -defer " + folder + "*.sv; " + script + "; " + std::string(kMergeEqualCells) +
                "; tee -o " + folder + "stat.txt stat"});
  return cells_of(read_text(folder + "stat.txt"));
}

std::string xc7_script(const std::string& top) {
  return "synth_xilinx -family xc7 -flatten -noiopad -top " + top + "; opt_merge; opt_clean";
}

Area xc7_area(const std::map<std::string, int>& cells) {
  return {total(cells, {"LUT", "INV"}) + memory_luts(cells), total(cells, {"FDRE", "FDSE", "FDCE", "FDPE"}),
          total(cells, {"DSP48E1"}), total(cells, {"RAMB18E1"}) + 2 * total(cells, {"RAMB36E1"})};
}

Area xc7_area(const Circuit& circuit) {
  const ScratchFolder scratch;
  const std::string folder = scratch.path().string() + "/";
  write_bench(folder, "core", {circuit});
  return xc7_area(cells_after(folder, xc7_script("core")));
}

Routed ice40_routed(const Circuit& circuit, int seed) {
  return routed(circuit, {"synth_ice40", "SB_LUT4", "nextpnr-ice40", {"--hx8k", "--package", "ct256"}}, seed);
}

Routed ecp5_routed(const Circuit& circuit, int seed) {
  return routed(circuit, {"synth_ecp5", "LUT4", "nextpnr-ecp5", {"--25k", "--package", "CABGA381", "--speed", "6"}},
                seed);
}

}  // namespace mote::hardware
