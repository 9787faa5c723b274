#include "mote/analog/placement.hpp"

#include <gtest/gtest.h>

#include "mote/analog/mixed_model.hpp"
#include "mote/analog/perfect.hpp"
#include "mote/graph/text/text_model.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/ungm.hpp"

namespace mote::analog {
namespace {

constexpr Method kMethods[] = {Method::kWeights, Method::kAllButResampling, Method::kAllButRandom};

graph::TextModel text(const std::string& law) {
  return {graph::parse_text_file("law.toml",
                                 "[states]\nh = \"normal(0, 1)\"\n[next]\nh = \"h + normal(0, 1)\"\n"
                                 "[observations]\n" +
                                     law + "\n"),
          {}};
}

void expect_circuits(const graph::Recorded& recorded, std::size_t arctans, std::size_t gaussians) {
  for (const Method method : kMethods) {
    const Placement placement = placed(recorded, method, {}, {});
    EXPECT_EQ(placement.arctans, arctans);
    EXPECT_EQ(placement.gaussians, gaussians);
  }
}

TEST(Placement, FindsTheCircuitsOfModels) {
  Doa three;
  three.frame = 3;
  expect_circuits(graph::record(Bearings{}), 1, 1);
  expect_circuits(graph::record(Ungm<1>{}), 0, 1);
  const Placement frame = placed(graph::record(three), Method::kWeights, {}, {});
  EXPECT_EQ(frame.gaussians, 3U);
  EXPECT_EQ(frame.arctans, 0U);  // the move's stays digital
  EXPECT_EQ(placed(graph::record(three), Method::kAllButResampling, {}, {}).arctans, 1U);
}

TEST(Placement, FindsTheCircuitsOfTexts) {
  expect_circuits(graph::record(text("y = \"normal(atan(h), 0.1)\"")), 1, 1);
  expect_circuits(graph::record(text("y = \"normal(0, exp(h/2))\"")), 0, 1);  // a scale that follows the state
  const auto mixture = graph::record(text("log_likelihood = \"log(0.9*exp(-(y - h)^2/2) + 0.1)\""));
  EXPECT_EQ(placed(mixture, Method::kWeights, {}, {}).gaussians, 1U);
  expect_circuits(graph::record(text("log_likelihood = \"-log(1 + (y - h)^2)\"")), 0, 0);
  expect_circuits(graph::record(text("log_likelihood = \"(y - h)^2\"")), 0, 0);  // grows: no Gaussian
}

std::size_t count(const Placement& placement, Part part) {
  return static_cast<std::size_t>(std::count(placement.parts.begin(), placement.parts.end(), part));
}

// claim    noise sources are the model's normal numbers; what analog memory draws for its own error is none of them
TEST(Placement, TakesTheErrorsOfMemoryForNoSources) {
  const auto recorded = graph::record(Bearings{});
  const Placement two = placed(recorded, Method::kAllButResampling, {}, {});
  EXPECT_EQ(count(two, Part::kSource), recorded.draws.size());
  EXPECT_EQ(count(two, Part::kMemory), 4 * recorded.states.size());  // z, its error, what is left, what is given back
  EXPECT_EQ(count(placed(recorded, Method::kWeights, {}, {}), Part::kMemory), 0U);
}

TEST(Placement, KnowsWhichGaussiansAnArctangentReaches) {
  const auto both = graph::record(text("y = \"normal(atan(h), 0.1)\"\nz = \"normal(h, 0.5)\""));
  for (const Method method : kMethods) {
    const Placement placement = placed(both, method, {}, {});
    EXPECT_EQ(std::count(placement.behind_arctan.begin(), placement.behind_arctan.end(), true), 1);
    for (graph::Id id = 0; id < placement.behind_arctan.size(); ++id)
      if (placement.behind_arctan[id]) {
        EXPECT_NEAR(inverse_sigma(placement, id).value_or(0), 10, 1e-9);
      }
  }
}

TEST(Placement, HasUseForTheArctangentOfAMoveByMethodTwo) {
  const auto recorded = graph::record(Doa{});
  EXPECT_FALSE(functions_of(recorded, Method::kWeights).arctan);
  EXPECT_TRUE(functions_of(recorded, Method::kAllButResampling).arctan);
  EXPECT_FALSE(functions_of(recorded, Method::kAllButRandom).gaussian);
}

TEST(Placement, LeavesDigitalWhatIsNotWanted) {
  const auto recorded = graph::record(Bearings{});
  EXPECT_EQ(placed(recorded, Method::kWeights, {true, false}, {}).gaussians, 0U);
  EXPECT_EQ(placed(recorded, Method::kWeights, {false, true}, {}).arctans, 0U);
}

/// The log likelihood of a placement with perfect circuits, less the model's.
template <class M>
double difference(const M& model, Method method, const StateOf<M, double>& x, const Row<double>& row) {
  const Design design = perfect_design(method);
  const MixedModel mixed(placed(graph::record(model), method, {}, design.cells), design, 1);
  SmallVector<double> state(x.begin(), x.end());
  return mixed.template log_likelihood<double>(3, state, row) - model.template log_likelihood<double>(3, x, row);
}

// claim    with perfect circuits the mixed-mode likelihood is the model's
// referee  the model; the table of a circuit is good to 1e-9
// twin     an arctangent that is 0.4 degrees off must be seen
TEST(Placement, ComputesTheModelByPerfectCircuits) {
  Bearings bearings;
  for (const Method method : kMethods)
    for (const double angle : {0.2, 0.59, 0.8, 1.4, 1.56, 1.7, 2.5, 3.1, -0.3, -1.2, -1.57, -2.0, -3.1}) {
      const std::array<double, 4> x{0.3 * std::cos(angle), 0.1, 0.3 * std::sin(angle), 0.2};
      const auto row = Row<double>::of({angle + 0.05, 0, 0, 0});
      EXPECT_NEAR(difference(bearings, method, x, row), 0, 1e-7) << angle;
    }
  Design off = perfect_design(Method::kWeights);
  off.arctan = behaviour_with(Function::kArctan, [](double) { return 0.007; });
  const MixedModel mixed(placed(graph::record(bearings), off.method, {}, off.cells), off, 1);
  const auto row = Row<double>::of({0.6, 0, 0, 0});
  const SmallVector<double> x{0.3 * std::cos(0.5), 0.0, 0.3 * std::sin(0.5), 0.0};
  EXPECT_GT(std::abs(mixed.log_likelihood<double>(3, x, row) -
                     bearings.log_likelihood<double>(3, {x[0], x[1], x[2], x[3]}, row)),
            0.1);
}

TEST(Placement, ComputesFramesAndGrowthByPerfectCircuits) {
  Doa three;
  three.frame = 3;
  EXPECT_NEAR(difference(three, Method::kWeights, {0.5, 0.1, 0.2}, Row<double>::of({0.45, 0.52, 0.6})), 0, 1e-6);
  EXPECT_NEAR(difference(Ungm<1>{}, Method::kWeights, {4.0}, Row<double>::of({1.5})), 0, 1e-7);
}

}  // namespace
}  // namespace mote::analog
