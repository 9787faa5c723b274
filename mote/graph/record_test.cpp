#include "mote/graph/record.hpp"

#include <gtest/gtest.h>

#include "mote/graph/print.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/laws.hpp"
#include "mote/model/linear_gaussian.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"

namespace mote::graph {
namespace {

LinearGaussian oscillator() {
  LinearGaussianParameters p;
  p.F = Eigen::MatrixXd{{0.9, 0.3}, {-0.3, 0.9}};
  p.Q = Eigen::MatrixXd{{0.5, 0.1}, {0.1, 0.4}};
  p.H = Eigen::MatrixXd{{1.0, 0.0}, {0.5, 2.0}};
  p.R = Eigen::MatrixXd{{0.3, 0.05}, {0.05, 0.6}};
  p.mean = Eigen::VectorXd{{1.0, -1.0}};
  p.covariance = Eigen::MatrixXd{{2.0, 0.3}, {0.3, 1.0}};
  return LinearGaussian(p);
}

/// Puts draws from lists under the numbers of a recording's draws.
std::vector<double> numbered(const laws::ListedDraw<double>& listed, const std::vector<bool>& normal) {
  std::vector<double> numbers;
  std::size_t normals = 0;
  std::size_t uniforms = 0;
  for (const bool is_normal : normal)
    numbers.push_back(is_normal ? listed.normals[normals++] : listed.uniforms[uniforms++]);
  return numbers;
}

/// The recording's outputs at a scene, each function with draws of its own.
template <class M>
std::vector<double> from_graph(const Recorded& recorded, const laws::Scene<M>& at,
                               const laws::ListedDraw<double>& prior, const laws::ListedDraw<double>& move) {
  const std::vector<double> schedule = recorded.schedule(at.t);
  const std::vector<double> prior_numbers = numbered(prior, recorded.prior_draws);
  const std::vector<double> numbers = numbered(move, recorded.draws);
  std::vector<double> values;
  evaluate(
      recorded.graph,
      [&](const Vertex& v) {
        switch (v.role) {
          case Role::kState:
            return at.x[v.index];
          case Role::kBefore:
            return at.before[v.index];
          case Role::kColumn:
            return at.y[v.index];
          case Role::kSchedule:
            return schedule[v.index];
          case Role::kPriorNormal:
          case Role::kPriorUniform:
            return prior_numbers[v.index];
          default:
            return numbers[v.index];
        }
      },
      values);
  std::vector<double> outputs;
  for (const Id id : recorded.outputs()) outputs.push_back(values[id]);
  return outputs;
}

// claim    a recording computes what the model's lines compute, bit for bit
// referee  the lines themselves, in double
// design   50 steps of a simulated run, all functions
// twin     another parameter, which must change some result
template <class M>
void expect_bit_for_bit(const M& model, const M& twin) {
  const Recorded recorded = record(model);
  const Recorded other = record(twin);
  auto block = Draws{21, 0}.block(Purpose::kTest);
  auto source = block.particle(0);
  std::size_t different = 0;
  for (Step t = 1; t <= 50; ++t) {
    const auto at = laws::scene(model, t, source);
    const auto prior = laws::listed(source);
    const auto move = laws::listed(source);
    std::vector<double> direct;
    auto prior_draw = prior;
    auto move_draw = move;
    for (const double v : model.template initial<double>(prior_draw)) direct.push_back(v);
    for (const double v : model.template next<double>(t, at.before, move_draw)) direct.push_back(v);
    direct.push_back(model.template log_likelihood<double>(t, at.x, at.y));
    if constexpr (HasTransition<M>)
      if (model.density() != Density::kNone)
        direct.push_back(model.template log_transition<double>(t, at.x, at.before));
    EXPECT_EQ(from_graph(recorded, at, prior, move), direct) << "t = " << t;
    different += from_graph(other, at, prior, move) != direct;
  }
  EXPECT_GT(different, 40U);
}

TEST(Record, GrowthModelBitForBit) { expect_bit_for_bit(Ungm<1>{}, Ungm<1>{{.a = 0.50001}}); }
TEST(Record, TwoGrowthModelsBitForBit) { expect_bit_for_bit(Ungm<2>{}, Ungm<2>{{.omega = 1.20001}}); }
TEST(Record, BearingsBitForBit) { expect_bit_for_bit(Bearings{}, Bearings{{.period = 1.0001}}); }
TEST(Record, BearingsWithEveryOptionBitForBit) {
  expect_bit_for_bit(Bearings{{.dof = 4, .correlation = 0.3, .distortion = 0.1}},
                     Bearings{{.dof = 5, .correlation = 0.3, .distortion = 0.1}});
  expect_bit_for_bit(Bearings{{.damping = 0.9, .sigma_across = 0.0005, .cruise = 0.1}},
                     Bearings{{.damping = 0.9, .sigma_across = 0.0005, .cruise = 0.11}});
}
TEST(Record, FramesOfDirectionsBitForBit) {
  for (const std::size_t frame : {std::size_t{1}, std::size_t{6}}) {
    expect_bit_for_bit(Doa{{}, frame}, Doa{{.sigma_o = 0.0501}, frame});
    expect_bit_for_bit(Doa{{.correlation = 0.3, .dof = 4}, frame}, Doa{{.correlation = 0.3, .dof = 5}, frame});
  }
}
TEST(Record, LocalLevelBitForBit) { expect_bit_for_bit(LocalLevel{}, LocalLevel{{.var_obs = 15098}}); }
TEST(Record, LinearGaussianBitForBit) {
  auto twin = oscillator().parameters();
  twin.H(0, 0) = 1.001;
  expect_bit_for_bit(oscillator(), LinearGaussian(twin));
}

TEST(Record, TakesWhatFollowsTheTimeForASchedule) {
  const Recorded recorded = record(Ungm<2>{});
  ASSERT_EQ(recorded.schedule(5).size(), 1U) << "both copies share one number";
  EXPECT_EQ(recorded.schedule(5)[0], 8 * std::cos(1.2 * 4));
  EXPECT_TRUE(record(Bearings{}).schedule(3).empty());
}

/// A model whose lines are others from step 10 on.
struct Changing : LocalLevel {
  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    const State<S> x = LocalLevel::next<S>(t, before, draw);
    return t < 10 ? x : State<S>{x[0] * x[0]};
  }
};

TEST(Record, RefusesAModelThatChangesItsOperations) {
  const Recorded recorded = record(Changing{});
  EXPECT_TRUE(recorded.schedule(9).empty());
  EXPECT_THROW(recorded.schedule(10), std::logic_error);
}

TEST(Record, CountsOperations) {
  const Recorded recorded = record(Ungm<1>{});
  const std::map<std::string, std::size_t> move{
      {"add", 4}, {"divide", 1}, {"multiply", 2}, {"multiply by constant", 1}};
  EXPECT_EQ(operations(recorded.graph, recorded.next), move);
  const std::array<Id, 1> weigh{recorded.log_likelihood};
  const std::map<std::string, std::size_t> weighing{
      {"add", 1}, {"multiply", 2}, {"multiply by constant", 2}, {"subtract", 1}};
  EXPECT_EQ(operations(recorded.graph, weigh), weighing);
}

TEST(Print, ShowsEveryVertexAndOutput) {
  const Recorded recorded = record(LocalLevel{{.var_level = 4, .var_obs = 1, .level0 = 0, .p0 = 9}});
  const std::string text = as_text(recorded);
  EXPECT_NE(text.find(" = level before\n"), std::string::npos) << text;
  EXPECT_NE(text.find(" = normal 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("next level = v"), std::string::npos) << text;
  EXPECT_NE(text.find("log_transition = v"), std::string::npos) << text;
  const std::string dot = as_dot(recorded);
  EXPECT_TRUE(dot.starts_with("digraph model {")) << dot;
  EXPECT_NE(dot.find("[shape=doublecircle,label=\"log_likelihood\"]"), std::string::npos) << dot;
}

}  // namespace
}  // namespace mote::graph
