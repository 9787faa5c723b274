#include <cmath>

#include <gtest/gtest.h>

#include "mote/graph/evaluate.hpp"
#include "mote/hardware/datapath/draws.hpp"
#include "tests/hardware/models.hpp"

namespace mote::hardware {
namespace {

using graph::Role;
using graph::Vertex;

/// The inputs that a call kept, by role and number.
class CallInputs {
 public:
  CallInputs(const graph::Recorded& recorded, const Samples::Call& call) : graph_(recorded.graph), call_(call) {}
  double operator()(Role role, std::uint32_t index) const {
    for (graph::Id id = 0; id < graph_.size(); ++id)
      if (const Vertex& v = graph_[id]; v.op == graph::Op::kInput && v.role == role && v.index == index)
        return call_[id];
    return 0;
  }

 private:
  const graph::Graph& graph_;
  const Samples::Call& call_;
};

/// The row and the schedule of a call.
Row<double> row_of(const Subject& subject, const CallInputs& inputs) {
  std::vector<double> values;
  for (std::uint32_t j = 0; j < subject.recorded.columns.size(); ++j) values.push_back(inputs(Role::kColumn, j));
  return Row<double>::of(std::move(values));
}
std::vector<double> schedule_of(const Subject& subject, const CallInputs& inputs) {
  std::vector<double> numbers;
  for (std::uint32_t j = 0; j < subject.recorded.schedule(1).size(); ++j) numbers.push_back(inputs(Role::kSchedule, j));
  return numbers;
}
Particles states_of(const Subject& subject, const CallInputs& inputs, Role role) {
  Particles states;
  for (std::uint32_t d = 0; d < subject.datapath.states.size(); ++d)
    states.push_back({subject.datapath.states[d].nearest(inputs(role, d))});
  return states;
}

/// What the recorded model gives for the circuit's own states.
std::vector<double> evaluated(const Subject& subject, const Samples::Call& call, const Particles& states, Role role,
                              const std::vector<double>& draws) {
  const CallInputs inputs(subject.recorded, call);
  std::vector<double> values;
  graph::evaluate(
      subject.recorded.graph,
      [&](const Vertex& v) {
        if (v.role == role) return subject.datapath.states[v.index].value(states[v.index][0]);
        if (v.role == Role::kNormal || v.role == Role::kUniform) return v.index < draws.size() ? draws[v.index] : 0.0;
        return inputs(v.role, v.index);
      },
      values);
  return values;
}

/// Root mean square difference, in octaves, of the circuit's log weights from the model's, where they count: less by
/// 1 / (1 + d / 8) at d octaves below the greatest.
double weigh_error(const Subject& subject) {
  const Datapath& datapath = subject.datapath;
  std::vector<double> wanted;
  std::vector<double> got;
  for (std::size_t k = 0; k < subject.samples.of(Part::kWeigh).size(); k += 16) {
    const Samples::Call& call = subject.samples.of(Part::kWeigh)[k];
    const CallInputs inputs(subject.recorded, call);
    const Particles states = states_of(subject, inputs, Role::kState);
    std::vector<std::int64_t> log_weight(1);
    const auto observed = datapath.observe(row_of(subject, inputs), schedule_of(subject, inputs));
    datapath.arithmetic.weigh(2, observed, states, log_weight);
    got.push_back(std::ldexp(static_cast<double>(log_weight[0]), -10) + datapath.constant);
    const auto values = evaluated(subject, call, states, Role::kState, {});
    wanted.push_back(values[subject.recorded.log_likelihood] * std::numbers::log2e);
  }
  const double greatest = *std::max_element(wanted.begin(), wanted.end());
  double squares = 0;
  for (std::size_t k = 0; k < got.size(); ++k)
    squares += std::pow((got[k] - std::max(wanted[k], -8192.0)) / (1 + (greatest - wanted[k]) / 8), 2);
  return std::sqrt(squares / static_cast<double>(got.size()));
}

/// The largest over the states of the root mean square difference of the circuit's move from the model's, over the
/// standard deviation that the draws give it or the filter's error, whichever is larger.
double propose_error(const Subject& subject) {
  const Datapath& datapath = subject.datapath;
  const std::size_t dims = datapath.states.size();
  std::vector<double> squares(dims);
  std::vector<double> spread(dims);
  Xoshiro bits = keyed_generator({1, 0, Purpose::kTest, 0}, 0);
  const auto& calls = subject.samples.of(Part::kNext);
  std::size_t count = 0;
  for (std::size_t k = 0; k < calls.size(); k += 16, ++count) {
    const CallInputs inputs(subject.recorded, calls[k]);
    const Particles parents = states_of(subject, inputs, Role::kBefore);
    WordColumns words;
    std::vector<double> draws;
    for (std::size_t w = 0; w < datapath.arithmetic.formats.draw_words; ++w)
      words.push_back({static_cast<std::uint32_t>(bits.next() >> 32U)});
    for (std::size_t w = 0; w < subject.recorded.draws.size(); ++w) {
      const std::uint32_t word = words[w][0];
      draws.push_back(subject.recorded.draws[w] ? normal_draw(word, false) : uniform_draw(word, false));
    }
    Particles moved(dims, std::vector<std::int64_t>(1));
    const auto observed = datapath.observe(row_of(subject, inputs), schedule_of(subject, inputs));
    datapath.arithmetic.propose(2, observed, parents, words, moved);
    const auto wanted = evaluated(subject, calls[k], parents, Role::kBefore, draws);
    const auto centre = evaluated(subject, calls[k], parents, Role::kBefore, std::vector<double>(draws.size()));
    for (std::size_t d = 0; d < dims; ++d) {
      const bool angle = subject.recorded.states[d].angle;
      const double x = wanted[subject.recorded.next[d]];
      const double error = datapath.states[d].value(moved[d][0]) - x;
      squares[d] += std::pow(angle ? numbers::wrap(error) : error, 2);
      const double drawn = x - centre[subject.recorded.next[d]];
      spread[d] += std::pow(angle ? numbers::wrap(drawn) : drawn, 2);
    }
  }
  double worst = 0;
  for (std::size_t d = 0; d < dims; ++d) {
    const double scale = std::max(std::sqrt(spread[d] / static_cast<double>(count)), subject.samples.errors[d]);
    worst = std::max(worst, std::sqrt(squares[d] / static_cast<double>(count)) / scale);
  }
  return worst;
}

// claim    log weights are the model's within 1/8 octave, moves within a tenth of the noise
// referee  the recorded model in double, on a filter's particles as the circuit holds them
// design   256 calls of each function, seeds fixed; the twin (six bits less after every point) must be caught
TEST(Datapath, ComputesTheModel) {
  for (const Subject& subject : subjects()) {
    const double weigh = weigh_error(subject);
    const double propose = propose_error(subject);
    std::printf("%-12s log weight: error %.4f octave, move: %.4f of its noise\n", subject.name.c_str(), weigh, propose);
    EXPECT_LT(weigh, 0.125) << subject.name;
    EXPECT_LT(propose, 0.1) << subject.name;
  }
  for (const Subject& rough : subjects({.more_bits = -6}))
    EXPECT_TRUE(weigh_error(rough) > 0.125 || propose_error(rough) > 0.1) << rough.name;
}

TEST(Datapath, LetsWhatWasNotSeenAddNothing) {
  const Subject growth = subject("ungm2", *catalogue_model("ungm", {"copies=2"}));
  const auto log_weight = [&](bool first, bool second, double y) {
    const Row<double> row{{y, 1.0}, {first, second}};
    std::vector<std::int64_t> weight(1);
    growth.datapath.arithmetic.weigh(2, growth.datapath.observe(row, {0.0}), {{40}, {-80}}, weight);
    return weight[0];
  };
  EXPECT_EQ(log_weight(false, false, kNaN), 0);
  EXPECT_EQ(log_weight(true, false, 3.0) + log_weight(false, true, 3.0), log_weight(true, true, 3.0));
  EXPECT_EQ(log_weight(false, true, kNaN), log_weight(false, true, 3.0));
  EXPECT_LT(log_weight(true, false, 3.0), 0);
}

TEST(Datapath, DrawsTheFirstParentsFromThePrior) {
  const Subject level = subject("local_level", *catalogue_model("local-level"));
  constexpr std::size_t kMany = 100'000;
  const auto spread = [&](unsigned t) {
    Xoshiro bits = keyed_generator({2, 0, Purpose::kTest, 0}, 0);
    WordColumns words(1, std::vector<std::uint32_t>(kMany));
    for (auto& column : words)
      for (std::uint32_t& word : column) word = static_cast<std::uint32_t>(bits.next() >> 32U);
    Particles states(1, std::vector<std::int64_t>(kMany));
    const auto observed = level.datapath.observe(Row<double>::of({1000.0}), {});
    level.datapath.arithmetic.propose(t, observed, Particles(1, std::vector<std::int64_t>(kMany, 0)), words, states);
    double sum = 0;
    double squares = 0;
    for (const std::int64_t word : states[0]) {
      const double x = level.datapath.states[0].value(word);
      sum += x;
      squares += x * x;
    }
    const double mean = sum / kMany;
    return std::pair(mean, std::sqrt(squares / kMany - mean * mean));
  };
  // claim   x_1 = 1120 + N(0, 100000) + N(0, 1469.1) at t = 1, the parent plus N(0, 1469.1) later
  // risk    none: fixed seed; standard errors are 1.0 of the mean and 0.7 of the deviation at t = 1
  EXPECT_NEAR(spread(1).first, 1120, 4);
  EXPECT_NEAR(spread(1).second, std::sqrt(100000 + 1469.1), 4);  // cut off at 4 deviations: 0.05 % less
  EXPECT_NEAR(spread(2).first, 0, 0.6);
  EXPECT_NEAR(spread(2).second, std::sqrt(1469.1), 1);
}

}  // namespace
}  // namespace mote::hardware
