#include "mote/analog/mixed_model.hpp"

#include <gtest/gtest.h>

#include "mote/analog/perfect.hpp"
#include "mote/graph/text/text_model.hpp"
#include "mote/model/bearings.hpp"

namespace mote::analog {
namespace {

/// Parts that are wrong, each by its own, and no noise, which particles by themselves do not have.
Design wrong_design(Method method) {
  Design design = perfect_design(method);
  design.cells = {};
  design.cells.comparator_noise = 0;
  design.dac = tlc5615();
  design.adc = ads7830();
  design.seed = 3;
  return design;
}

/// A filter's particles moved and weighed by a model, one by one.
struct OneByOne {
  Particles<double> x;
  std::vector<double> log_weights;
};
OneByOne one_by_one(const MixedModel& model, const Draws& draws, Particles<double> x, std::size_t first,
                    std::size_t last, const Row<double>& row) {
  OneByOne done{std::move(x), std::vector<double>(done.x.size(), 0.0)};
  SmallVector<double> state(done.x.dimensions());
  draws.for_each(Purpose::kMove, 0, last, [&](std::size_t i, auto& draw) {
    done.x.read(i, state);
    const auto moved = model.next<double>(5, state, draw);
    if (i < first) return;
    done.x.write(i, moved);
    done.log_weights[i] = model.log_likelihood<double>(5, moved, row);
  });
  return done;
}

template <class M>
void expect_the_same(const M& model, const Row<double>& row) {
  for (const Method method : {Method::kWeights, Method::kAllButResampling, Method::kAllButRandom}) {
    const Design design = wrong_design(method);
    const MixedModel mixed(placed(graph::record(model), method, {}, design.cells), design, 1);
    const Draws draws{8, 5};
    Particles<double> x(mixed.states().size(), 1300);
    for (std::size_t d = 0; d < x.dimensions(); ++d)
      for (std::size_t i = 0; i < x.size(); ++i) x.component(d)[i] = 0.3 + 0.01 * std::sin(1.0 + double(i * (d + 1)));
    const std::size_t first = 40;
    const OneByOne expected = one_by_one(mixed, draws, x, first, x.size(), row);
    mixed.move_all(5, {draws, Purpose::kMove, first}, x, first, x.size());
    std::vector<double> log_weights(x.size(), 0.0);
    mixed.weigh_all(5, Rows<double>(&row, 1), x, first, log_weights);
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t d = 0; d < x.dimensions(); ++d) ASSERT_EQ(x.component(d)[i], expected.x.component(d)[i]) << i;
      ASSERT_EQ(log_weights[i], expected.log_weights[i]) << i;
    }
  }
}

// claim    particles moved and weighed side by side are those moved and weighed one by one, bit for bit
// design   a stretch that begins inside a tile and goes over the end of a block; every part wrong by its own
TEST(MixedModel, ComputesSideBySideWhatItDoesOneByOne) {
  expect_the_same(Bearings{}, Row<double>::of({0.7, 0, 0, 0}));
  expect_the_same(graph::TextModel(graph::parse_text_file("waves.toml",
                                                          "[states]\na = \"normal(0, 1)\"\n[next]\n"
                                                          "a = \"a*cos(t/3) + uniform(-0.1, 0.1) + 0.1*normal(0, 1)\"\n"
                                                          "[observations]\ny = \"normal(atan(a), 0.2)\"\n"),
                                   {}),
                  Row<double>::of({0.4}));
}

TEST(MixedModel, WeighsNothingByARowWithAValueMissing) {
  const Design design = wrong_design(Method::kWeights);
  const MixedModel mixed(placed(graph::record(Bearings{}), design.method, {}, design.cells), design, 1);
  const Particles<double> x(4, 100);
  std::vector<double> log_weights(x.size(), 1.5);
  const Row<double> row{{0.7, 0, 0, 0}, {false, true, true, true}};
  mixed.weigh_all(1, Rows<double>(&row, 1), x, 0, log_weights);
  EXPECT_EQ(log_weights, std::vector<double>(x.size(), 1.5));
}

}  // namespace
}  // namespace mote::analog
