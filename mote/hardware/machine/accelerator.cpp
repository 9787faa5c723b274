#include "mote/hardware/machine/accelerator.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/filled_in.hpp"
#include "mote/base/refusal.hpp"
#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/filters/offspring.hpp"
#include "mote/hardware/filters/weights.hpp"
#include "mote/hardware/machine/templates.hpp"
#include "mote/hardware/random.hpp"
#include "mote/hardware/sketch.hpp"
#include "mote/hardware/words.hpp"

namespace mote::hardware {
namespace {

using Matrix = std::vector<std::vector<double>>;

constexpr int kNormalFraction = 14;
constexpr double kMostNormal = 6.8;
constexpr int kWordBits = 18;

/// L of C = L L' (Cholesky).
Matrix triangular_factor(const Matrix& c) {
  Matrix l(c.size(), std::vector<double>(c.size()));
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = c[i][j];
      for (std::size_t k = 0; k < j; ++k) rest -= l[i][k] * l[j][k];
      if (i == j && !(rest > 0))
        throw Refusal(ExitCode::kWrongUse, {"circuit", "covariance", "a positive definite matrix",
                                            "a pivot of " + std::to_string(rest), "Pass variances above 0."});
      l[i][j] = i == j ? std::sqrt(rest) : rest / l[j][j];
    }
  return l;
}

/// Words that hold L z.
Format vector_format(const Matrix& l) {
  double most = 0;
  for (const auto& row : l) {
    double sum = 0;
    for (const double factor : row) sum += std::abs(factor);
    most = std::max(most, kMostNormal * sum);
  }
  const int integer = static_cast<int>(std::ceil(std::log2(most)));
  return {true, integer, kWordBits - 1 - integer};
}

/// Words to L z: two normal numbers of each two words.
Compound vectors_of_normals(const std::string& name, const Matrix& l, const Format& x) {
  Sketch s(name, Multiplier::kDsp);
  const Format z{true, 3, kNormalFraction};
  std::vector<Signal> normals;
  const Compound pair = box_muller(kNormalFraction);
  for (std::size_t w = 0; w < (l.size() + 1) / 2 * 2; w += 2) {
    const Signal radius = s.input("word" + std::to_string(w) + "_i", kSignedBits);
    const Signal angle = s.input("word" + std::to_string(w + 1) + "_i", kPlainBits);
    normals.push_back(s.op(pair, z, radius, angle));
    normals.push_back({{normals.back().wire.node, 1}, z});
  }
  for (std::size_t i = 0; i < l.size(); ++i) {
    Signal sum = s.scaled(normals[i], l[i][i], 16, x);
    for (std::size_t j = 0; j < i; ++j)
      if (l[i][j] != 0) sum = s.sum(sum, s.scaled(normals[j], l[i][j], 16, x), x);
    s.output("x" + std::to_string(i) + "_o", sum);
  }
  return s.done();
}

std::vector<Beat> normal_beats(const Compound& vectors, std::size_t dims, std::uint64_t seed, std::size_t words) {
  const std::size_t streams = (dims + 1) / 2 * 2;
  std::vector<std::vector<Word>> in(streams), out(dims, std::vector<Word>(words));
  for (std::size_t w = 0; w < streams; ++w) {
    Words source(seed, static_cast<unsigned>(w));
    for (std::size_t k = 0; k < words; ++k) {
      const std::uint32_t word = source.next();
      in[w].push_back(w % 2 == 0 ? signed_bits(word) : Word{word});
    }
  }
  vectors.compute(std::vector<std::span<const Word>>(in.begin(), in.end()),
                  std::vector<std::span<Word>>(out.begin(), out.end()));
  std::vector<Beat> beats(words);
  for (std::size_t k = 0; k < words; ++k)
    for (const auto& column : out) beats[k].fields.push_back(column[k]);
  return beats;
}

std::string top_bit(int width) { return std::to_string(width - 1); }

int as_int(unsigned number) { return static_cast<int>(number); }

std::string stream_sheet(const char* direction, const Stream& stream) {
  std::string text = "//           " + stream.name + ", " + direction + ":\n";
  int at = 0;
  for (const Field& field : stream.fields) {
    text += "//             " + std::to_string(at + field.format.width() - 1) + ":" + std::to_string(at) + "  " +
            field.format.name() + "  " + field.name + '\n';
    at += field.format.width();
  }
  return text;
}

/// The log weights of states, step by step: an observation, its states to the one with `last`.
std::vector<Beat> weighed(const ModelCircuit& model, const std::vector<Beat>& observations,
                          const std::vector<Beat>& states) {
  std::vector<Beat> out;
  std::size_t begin = 0;
  for (std::size_t step = 0; step < observations.size() && begin < states.size(); ++step) {
    std::size_t end = begin;
    while (end < states.size() && !states[end].last) ++end;
    end = std::min(end + 1, states.size());
    Particles columns(model.states.size());
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t d = 0; d < columns.size(); ++d) columns[d].push_back(states[i].fields[d]);
    std::vector<std::int64_t> logs(end - begin);
    model.arithmetic.weigh(static_cast<unsigned>(step + 1), observations[step].fields, columns, logs);
    for (std::size_t i = begin; i < end; ++i) out.push_back({{logs[i - begin]}, states[i].last});
    begin = end;
  }
  return out;
}

}  // namespace

int Stream::field_bits() const {
  int bits = 0;
  for (const Field& field : fields) bits += field.format.width();
  return bits;
}

int Stream::bits() const { return (field_bits() + 7) / 8 * 8; }

std::string Accelerator::sheet() const {
  std::string text;
  for (const Stream& stream : in) text += stream_sheet("in", stream);
  return text + stream_sheet("out", out);
}

int Accelerator::pins() const {
  int pins = 2 + out.bits() + 2 + (out.last ? 1 : 0);
  for (const Stream& stream : in) pins += stream.bits() + 2 + (stream.last ? 1 : 0);
  for (const auto& [port, value] : registers) pins += port.width;
  return pins;
}

std::vector<DesignFile> Accelerator::modules(const std::string& folder) const {
  auto all_places = places;
  all_places.insert({{"name", name}, {"meaning", meaning}, {"timing", timing}, {"sheet", sheet()}, {"folder", folder}});
  for (const Stream& stream : in) {
    all_places[stream.name + "_top"] = top_bit(stream.bits());
    all_places[stream.name + "_field_top"] = top_bit(stream.field_bits());
  }
  all_places[out.name + "_top"] = top_bit(out.bits());
  for (const Part& part : parts)
    all_places[part.instance] = instantiation(part.circuit, part.instance, folder, part.connections);
  std::vector<DesignFile> own;
  for (const Part& part : parts)
    for (const Source& one : part.circuit.sources)
      if (std::none_of(own.begin(), own.end(), [&](const auto& file) { return file.name == one.name + ".sv"; }))
        own.push_back({one.name + ".sv", one.text});
  own.push_back({name + ".sv", filled_in(machine_template(source), all_places)});
  std::string text;
  for (const DesignFile& file : own) text += file.text;
  std::vector<DesignFile> all;
  for (const RtlFile& file : needed_of_library(text)) all.push_back({std::string(file.name), std::string(file.text)});
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

std::vector<DesignFile> Accelerator::tables() const {
  std::vector<DesignFile> all;
  for (const Part& part : parts)
    for (const Memory& memory : part.circuit.memories)
      all.push_back({memory_file(part.instance, memory), memory.text()});
  return all;
}

Accelerator gaussian_accelerator(const Matrix& covariance, std::uint64_t seed) {
  const Matrix factor = triangular_factor(covariance);
  const std::size_t dims = factor.size();
  const Format x = vector_format(factor);
  const Compound vectors = vectors_of_normals("mote_gaussian_vectors", factor, x);
  const Circuit circuit = vectors.circuit();
  Accelerator made{"mote_gaussian",
                   "vectors of normal numbers, Box-Muller by CORDIC, with a covariance",
                   "one vector a clock; latency " + std::to_string(circuit.latency + 1) + " after a reset",
                   {},
                   {},
                   {},
                   nullptr,
                   {},
                   "gaussian.sv.in",
                   {}};
  made.out.name = "normal";
  ModelCircuit::Connections connections{{"clk_i", "clk_i"}};
  std::string sources, together;
  for (std::size_t w = 0; w < circuit.inputs.size(); ++w) {
    const std::string n = std::to_string(w);
    sources += "  logic [31:0] word" + n + ";\n  mote_words #(.Seed(64'd" + std::to_string(seed) + "), .Stream(" + n +
               ")) u_words" + n + " (.clk_i, .rst_ni, .advance_i(room), .word_o(word" + n + "));\n";
    connections.emplace_back("word" + n + "_i", "word" + n);
  }
  for (std::size_t d = 0; d < dims; ++d) {
    const std::string n = std::to_string(d);
    made.out.fields.push_back({"x" + n, x});
    sources += "  logic [" + top_bit(x.width()) + ":0] x" + n + ";\n";
    connections.emplace_back("x" + n + "_o", "x" + n);
    together = "x" + n + (together.empty() ? "" : ", ") + together;
  }
  made.parts = {{"u_vectors", circuit, connections}};
  made.places = {{"sources", sources},
                 {"together", together},
                 {"width", std::to_string(made.out.field_bits())},
                 {"bits", std::to_string(made.out.bits())},
                 {"latency", std::to_string(circuit.latency)},
                 {"seed", std::to_string(seed)}};
  made.golden = [vectors, dims, seed](const std::vector<std::vector<Beat>>&, std::size_t words) {
    return normal_beats(vectors, dims, seed, words);
  };
  return made;
}

Accelerator likelihood_accelerator(const ModelCircuit& model) {
  const Formats& f = model.arithmetic.formats;
  Accelerator made{"mote_" + model.name + "_likelihood",
                   "the log likelihood of the model " + model.name + ", octaves",
                   "one state a clock; latency " + std::to_string(f.weigh_latency + 1) +
                       "; 4 clocks from an observation to its first state, the next one when its last state is through",
                   {{"obs", model.observed, false}, {"state", model.states, true}},
                   {"log", {{"log2 p(y | x) but for a constant", {true, as_int(f.log_bits) - 11, 10}}}, true},
                   {},
                   nullptr,
                   {{"u_weigh", model.weigh, model.weigh_connections}},
                   "likelihood.sv.in",
                   {}};
  made.places = {{"weigh_module", model.weigh.module},
                 {"latency", std::to_string(f.weigh_latency)},
                 {"log_width", std::to_string(f.log_bits)},
                 {"log_bits", std::to_string(made.out.bits())}};
  made.golden = [model](const std::vector<std::vector<Beat>>& in, std::size_t) { return weighed(model, in[0], in[1]); };
  return made;
}

std::vector<std::uint32_t> resampled(const std::vector<std::int64_t>& log_weights, const Formats& formats,
                                     std::uint32_t uniform) {
  std::vector<ScaledWeight> weights(log_weights.size());
  scale_weights(log_weights, 1, formats.weight_bits, weights);
  return parents_of(Offspring{formats.weight_bits, formats.count_bits}.ends(weights, sum_of(weights), uniform));
}

Accelerator resampler_accelerator(std::uint32_t most, std::uint32_t n, std::uint64_t seed) {
  const int at = std::max(6, ceil_log2(most));
  Formats f;
  f.count_bits = static_cast<unsigned>(at);
  const Format parent{false, at, 0};
  Circuit exponential{
      "", {}, {}, {}, 0, false, {{"Exp2Table", kMantissaBits, {exp2_table().begin(), exp2_table().end()}}}};
  Accelerator made{"mote_resampler_" + std::to_string(1 << at),
                   "systematic resampling of sets of particles",
                   "a log weight a clock, then up to a parent a clock; the next set when the last parent has left",
                   {{"log", {{"log2 weight", {true, as_int(f.log_bits) - 11, 10}}}, false}},
                   {"parent", {{"parent of the next child", parent}}, true},
                   {{{"n_i", at + 1}, n}},
                   nullptr,
                   {{"u_resampler", exponential, {}}},
                   "resampler.sv.in",
                   {}};
  made.places = {{"at", std::to_string(at)},
                 {"most", std::to_string(1 << at)},
                 {"parent_bits", std::to_string(made.out.bits())},
                 {"table", memory_file("u_resampler", exponential.memories.front())},
                 {"seed", std::to_string(seed)}};
  made.golden = [f, n, seed](const std::vector<std::vector<Beat>>& in, std::size_t) {
    Words words(seed, 0);
    std::vector<Beat> out;
    for (std::size_t begin = 0; begin + n <= in[0].size(); begin += n) {
      std::vector<std::int64_t> logs;
      for (std::size_t i = begin; i < begin + n; ++i) logs.push_back(in[0][i].fields[0]);
      for (const std::uint32_t one : resampled(logs, f, words.next() >> 8)) out.push_back({{one}, false});
      out.back().last = true;
    }
    return out;
  };
  return made;
}

}  // namespace mote::hardware
