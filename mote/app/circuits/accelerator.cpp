#include "mote/app/circuits/accelerator.hpp"

#include <cmath>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/circuits/folder.hpp"
#include "mote/app/circuits/report.hpp"
#include "mote/base/filled_in.hpp"
#include "mote/hardware/machine/bits.hpp"
#include "mote/hardware/machine/templates.hpp"

namespace mote {
namespace {

using hardware::Accelerator;
using hardware::Beat;
using hardware::Stream;

std::string beats_hex(const Stream& stream, const std::vector<Beat>& beats) {
  std::string text;
  for (const Beat& beat : beats) {
    hardware::BitWriter bits(stream.bits() + 1);
    for (std::size_t k = 0; k < beat.fields.size(); ++k) bits.append(beat.fields[k], stream.fields[k].format.width());
    // tdata's padding repeats the sign of a signed word
    const bool negative = stream.fields.back().format.sign && beat.fields.back() < 0;
    bits.append(negative ? -1 : 0, stream.bits() - stream.field_bits());
    bits.append(beat.last ? 1 : 0, 1);
    text += hex_of(bits.words());
  }
  return text;
}

/// What a testbench connects a stream to: words[seen] of an input, out_* of the output.
std::string connections_of(const Stream& in) {
  const std::string word = fmt::format("{0}_words[{0}_valid ? {0}_seen : 0]", in.name);
  std::string text =
      fmt::format(".{0}_tdata_i({1}[{2}:0]), .{0}_tvalid_i({0}_valid), .{0}_tready_o({0}_ready),\n      ", in.name,
                  word, in.bits() - 1);
  if (in.last) text += fmt::format(".{0}_tlast_i({1}[{2}]),\n      ", in.name, word, in.bits());
  return text;
}

std::string testbench_of(const PlayedAccelerator& played) {
  const Accelerator& made = played.made;
  std::string streams, connections;
  std::size_t beats = played.words;
  for (const auto& [port, value] : made.registers)
    connections += fmt::format(".{}({}'d{}),\n      ", port.name, port.width, value);
  for (std::size_t k = 0; k < made.in.size(); ++k) {
    streams += filled_in(hardware::machine_template("accelerator_stream.sv.in"),
                         {{"stream", made.in[k].name},
                          {"bits", fmt::format("{}", made.in[k].bits())},
                          {"count", fmt::format("{}", played.in[k].size())}});
    connections += connections_of(made.in[k]);
    beats += played.in[k].size();
  }
  connections +=
      fmt::format(".{0}_tdata_o(out_word), .{0}_tvalid_o(out_valid), .{0}_tready_i(out_ready)", made.out.name);
  if (made.out.last) connections += fmt::format(",\n      .{}_tlast_o(out_last)", made.out.name);
  return filled_in(hardware::machine_template("accelerator_testbench.sv.in"),
                   {{"name", made.name},
                    {"words", fmt::format("{}", played.words)},
                    {"streams", streams},
                    {"connections", connections},
                    {"out", made.out.name},
                    {"out_bits", fmt::format("{}", made.out.bits())},
                    {"last", made.out.last ? "" : "  assign out_last = 1'b0;"},
                    {"most_cycles", fmt::format("{}", 10 * beats + 10000)}});
}

std::string stream_rows(const Stream& stream) {
  std::string text;
  int at = 0;
  for (const hardware::Field& field : stream.fields) {
    text += fmt::format("| `{}` | {}:{} | {} | {} |\n", stream.name, at + field.format.width() - 1, at,
                        field.format.name(), field.name);
    at += field.format.width();
  }
  return text;
}

std::vector<report::Fact> facts_of(const Accelerator& made, const std::optional<hardware::Cost>& cost) {
  std::vector<report::Fact> facts{{"circuit", made.name + ": " + made.meaning}, {"timing", made.timing}};
  if (cost) append_cost(facts, *cost);
  if (cost && cost->power_mw)
    facts.push_back({"power", fmt::format("{:.0f} mW, an estimate by resources and one bit in eight changing a clock",
                                          *cost->power_mw)});
  return facts;
}

}  // namespace

PlayedAccelerator played_gaussian(const std::vector<std::vector<double>>& covariance, std::uint64_t seed) {
  return {hardware::gaussian_accelerator(covariance, seed), {}, 1000};
}

PlayedAccelerator played_likelihood(const FilterCircuit& circuit, const CircuitDesign& design,
                                    const Recording& recording, const std::string& where) {
  PlayedAccelerator played{hardware::likelihood_accelerator(circuit.machine->model()), {{}, {}}, 0};
  const auto golden = circuit.machine->golden();
  golden->start(design.registers);
  for (const auto& observed : observed_by(circuit, recording, where)) {
    golden->step(observed);
    played.in[0].push_back({observed, false});
    const hardware::Particles& set = golden->set();
    for (std::size_t i = 0; i < set[0].size(); ++i) {
      Beat& beat = played.in[1].emplace_back();
      for (const auto& column : set) beat.fields.push_back(column[i]);
      beat.last = i + 1 == set[0].size();
    }
  }
  played.words = played.in[1].size();
  return played;
}

PlayedAccelerator played_resampler(std::uint32_t n, std::uint64_t seed) {
  PlayedAccelerator played{hardware::resampler_accelerator(n, n, seed), {{}}, 0};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (const double spread : {0.0, 0.1, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0})
    for (std::uint32_t i = 0; i < n; ++i)
      played.in[0].push_back({{std::llround(-1024 * spread * std::abs(normal(random)))}, false});
  played.words = played.in[0].size();
  return played;
}

nlohmann::json accelerator_json(const std::optional<hardware::Cost>& cost) { return cost_json(cost); }

std::string accelerator_text(const Accelerator& made, const std::optional<hardware::Cost>& cost) {
  std::string text;
  for (const report::Fact& fact : facts_of(made, cost)) text += fmt::format("{:<14}{}\n", fact.name, fact.value);
  return text;
}

void write_accelerator(OutputSet& outputs, const std::string& folder, const PlayedAccelerator& played,
                       const std::optional<hardware::Cost>& cost, const std::string& command) {
  const Accelerator& made = played.made;
  std::string figures, streams;
  for (const report::Fact& fact : facts_of(made, cost)) figures += fmt::format("| {} | {} |\n", fact.name, fact.value);
  for (const Stream& stream : made.in) streams += stream_rows(stream);
  streams += stream_rows(made.out);
  DesignFiles files{
      {"README.md", filled_in(hardware::machine_template("accelerator_README.md.in"), {{"name", made.name},
                                                                                       {"meaning", made.meaning},
                                                                                       {"command", command},
                                                                                       {"figures", figures},
                                                                                       {"streams", streams}})},
      {"circuit.json", accelerator_json(cost).dump(2) + "\n"},
      {"testbench/run.sh", std::string(hardware::machine_template("run.sh.in"))},
      {"testbench/testbench.sv", testbench_of(played)},
      {"testbench/" + made.out.name + ".hex", beats_hex(made.out, made.golden(played.in, played.words))}};
  for (std::size_t k = 0; k < made.in.size(); ++k)
    files["testbench/" + made.in[k].name + ".hex"] = beats_hex(made.in[k], played.in[k]);
  for (const hardware::DesignFile& file : made.modules("")) files["rtl/" + file.name] = file.text;
  for (const hardware::DesignFile& file : made.tables()) files["tables/" + file.name] = file.text;
  write_files(outputs, folder, files);
}

}  // namespace mote
