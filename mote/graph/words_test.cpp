#include "mote/graph/words.hpp"

#include <gtest/gtest.h>

#include "mote/graph/replay.hpp"
#include "mote/model/ungm.hpp"

namespace mote::graph {
namespace {

/// A recording that was moved and weighed, and what was seen.
struct Watched {
  Recorded recorded = record(Ungm<1>{});
  std::shared_ptr<WatchedArithmetic> arithmetic = std::make_shared<WatchedArithmetic>(recorded.graph);

  Watched() {
    const Replayed<WatchedArithmetic> model(recorded, arithmetic);
    auto block = Draws{3, 0}.block(Purpose::kTest);
    auto draw = block.particle(0);
    auto x = model.initial<double>(draw);
    for (Step t = 1; t <= 500; ++t) {
      x = model.next<double>(t, x, draw);
      model.log_likelihood<double>(t, x, Row<double>::of({x[0] * x[0] / 20}));
    }
  }
};

TEST(Replayed, ComputesWhatTheModelDoes) {
  const Ungm<1> model;
  const Recorded recorded = record(model);
  const Replayed<WatchedArithmetic> replayed(recorded, std::make_shared<WatchedArithmetic>(recorded.graph));
  auto one_block = Draws{4, 0}.block(Purpose::kTest);
  auto other_block = Draws{4, 0}.block(Purpose::kTest);
  auto one = one_block.particle(0);
  auto other = other_block.particle(0);
  auto x = model.initial<double>(one);
  EXPECT_EQ(replayed.initial<double>(other)[0], x[0]);
  for (Step t = 1; t <= 20; ++t) {
    const auto y = Row<double>::of({1.5});
    EXPECT_EQ(replayed.log_likelihood<double>(t, {x[0]}, y), model.log_likelihood<double>(t, x, y));
    const auto next = replayed.next<double>(t, {x[0]}, other);
    x = model.next<double>(t, x, one);
    EXPECT_EQ(next[0], x[0]);
  }
  EXPECT_EQ(replayed.log_likelihood<double>(1, {x[0]}, {{1.5}, {false}}), 0);
}

TEST(Ranges, HoldWhatWasSeenWithAMargin) {
  const Watched watched;
  const Ranges all = ranges(watched.recorded, watched.arithmetic->seen());
  for (const Id id : watched.recorded.next) {
    EXPECT_LT(all.kept[id].low, all.seen[id].low);
    EXPECT_GT(all.kept[id].high, 1.2 * all.seen[id].high);
  }
  std::size_t narrowed = 0;
  for (Id id = 0; id < watched.recorded.graph.size(); ++id) {
    if (all.seen[id].low > all.seen[id].high) continue;
    EXPECT_TRUE(all.kept[id].contains(all.seen[id].low)) << id;
    EXPECT_TRUE(all.kept[id].contains(all.seen[id].high)) << id;
    narrowed += all.kept[id].high < all.analysed[id].high;
  }
  EXPECT_GT(narrowed, 3U) << "analysis alone takes x / (1 + x^2) for two numbers";
}

TEST(Words, AreTheSmallestThatPass) {
  // the error is that of x: known in closed form, so what the search must find is known
  Graph graph;
  const Id x = graph.input(Role::kState, 0);
  const Id unused = graph.input(Role::kState, 1);
  const Id sum = graph.operation(Op::kAdd, {x, graph.constant(0.5)});
  const std::array<Id, 1> outputs{sum};
  Ranges known;
  known.kept = {{-3, 3}, {-100, 100}, {0.5, 0.5}, {-2.5, 3.5}};
  const auto error = [&](const FixedPoint& point) { return 1 + std::ldexp(1.0, -point.formats[x].fraction); };
  const Words words = search_words(graph, outputs, known, error, {.budget = 0.01});
  EXPECT_TRUE(words.within_budget);
  EXPECT_EQ(words.point.formats[x], (Format{true, 2, 7})) << "2^-7 is the first below 0.01";
  EXPECT_EQ(words.ratio, 1 + std::ldexp(1.0, -7));
  EXPECT_LE(words.point.formats[sum].width(), 2) << "nobody reads its bits";
  EXPECT_LE(words.point.formats[graph.constant(0.5)].width(), 2);
  EXPECT_LT(total_bits(graph, outputs, words.point), 16U);
  EXPECT_GT(words.point.formats[unused].width(), 0);
  EXPECT_FALSE(search_words(graph, outputs, known, error, {.budget = 1e-9}).within_budget);
}

TEST(FixedArithmetic, FollowsTheDoubleMoreCloselyWithMoreBits) {
  const Watched watched;
  const Recorded& recorded = watched.recorded;
  const Ranges all = ranges(recorded, watched.arithmetic->seen());
  const auto worst = [&](int fraction) {
    FixedPoint point;
    for (Id id = 0; id < recorded.graph.size(); ++id) point.formats.push_back(format_for(all.kept[id], fraction));
    const Replayed<FixedArithmetic> fixed(recorded, std::make_shared<FixedArithmetic>(recorded.graph, point));
    double most = 0;
    for (double x = -20; x < 20; x += 0.37) {
      auto one_block = Draws{5, 0}.block(Purpose::kTest);
      auto other_block = Draws{5, 0}.block(Purpose::kTest);
      auto one = one_block.particle(0);
      auto other = other_block.particle(0);
      most = std::max(most, std::abs(fixed.next<double>(3, {x}, one)[0] - Ungm<1>{}.next<double>(3, {x}, other)[0]));
    }
    return most;
  };
  EXPECT_LT(worst(20), 1e-4);
  EXPECT_GT(worst(6), 100 * worst(20));
}

}  // namespace
}  // namespace mote::graph
