#include "mote/app/explore/search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::explore {
namespace {

constexpr std::size_t kRecordings = 16;

/// Made-up candidates on a machine with two figures: candidate c = (a, b) takes time a and area b, and errs by
/// 10 / sqrt(a b) times a difficulty that the seed draws for all alike. Some collapse: while they are timed, or in
/// runs.
class Synthetic final : public Target {
 public:
  using Which = std::function<bool(const Words&)>;
  explicit Synthetic(Which collapse_timed = {}, Which collapse_run = {})
      : collapse_timed_(std::move(collapse_timed)), collapse_run_(std::move(collapse_run)) {
    for (int a = 1; a <= 8; ++a)
      for (int b = 1; b <= 8; ++b) candidates_.push_back({std::to_string(a), std::to_string(b)});
  }
  std::string name() const override { return "made-up"; }
  std::string meaning() const override { return "made up"; }
  std::vector<Figure> figures() const override { return {{"time", "s", "--deadline"}, {"area", "", ""}}; }
  const std::vector<Words>& candidates() const override { return candidates_; }
  bool measures() const override { return false; }
  std::vector<double> takes(std::size_t c, Memory& memory) const override {
    return memory.recall(fmt::format("takes {}", c), 2, [&] {
      ++found;
      if (collapse_timed_ && collapse_timed_(candidates_[c])) throw Refusal(ExitCode::kCollapsed, "collapsed");
      return std::vector<double>{a(c), b(c)};
    });
  }
  RunRecord run(std::size_t c, const Recording&, std::uint64_t seed) const override {
    ++ran;
    if (collapse_run_ && collapse_run_(candidates_[c])) throw Refusal(ExitCode::kCollapsed, "collapsed");
    const double own = Draws{seed, 1, static_cast<std::uint32_t>(c)}.uniform(Purpose::kTest);
    const double shared = Draws{seed, 2}.uniform(Purpose::kTest);
    RunRecord record;
    record.rows.push_back({1, {{error(c) * (1 + 3 * shared) * (0.95 + 0.1 * own), 0}}, {}, {}});
    return record;
  }
  std::string command(std::size_t c, const std::string&) const override { return fmt::format("{}", c); }

  double a(std::size_t c) const { return std::stod(candidates_[c][0]); }
  double b(std::size_t c) const { return std::stod(candidates_[c][1]); }
  double error(std::size_t c) const { return 10 / std::sqrt(a(c) * b(c)); }

  mutable std::atomic<int> found{0}, ran{0};

 private:
  std::vector<Words> candidates_;
  Which collapse_timed_, collapse_run_;
};

/// Recordings of a step whose posterior mean is 0.
Jury jury() {
  compare::Design design;
  design.where = "test";
  design.catalogue_model = find_model("local-level", "test").make(Settings("test", {}), {});
  design.repeats = 1000;
  design.target = {"level", "", {0}};
  design.reference.name = "0";
  for (std::size_t k = 0; k < kRecordings; ++k) {
    design.scenes.emplace_back();
    design.reference.solutions.push_back({{{0.0}}, 0});
  }
  return Jury(std::move(design));
}

const std::atomic<bool> kGo{false};

Finding found_by(const Synthetic& target, const Order& order, Journal& journal) {
  return search(
      target, jury(), journal, order, [](const char*, std::size_t, std::size_t) {}, kGo);
}

Finding found_by(const Synthetic& target, const Order& order) {
  Journal journal("", {});
  return found_by(target, order, journal);
}

Order order_of(std::vector<design::Limit> limits, std::size_t goal) { return {std::move(limits), goal, {4, 64}, 2}; }

// referee  by hand: within time 4 and area 3 the least error is that of (4, 3)
TEST(Search, PicksTheLeastErrorWithinBudgets) {
  const Synthetic target;
  const Finding found = found_by(target, order_of({{0, 4}, {1, 3}}, 2));
  EXPECT_TRUE(found.feasible);
  EXPECT_EQ(target.candidates()[found.pick], (Words{"4", "3"}));
  const Standing& s = found.standings[found.pick];
  EXPECT_EQ(s.runs, 64U);
  EXPECT_LT(s.interval.low, s.rmse);
  EXPECT_GT(s.interval.high, s.rmse);
  EXPECT_TRUE(std::isnan(s.rmse_truth));
}

// claim    every budget on the error is met with the least time that brute force finds
// referee  all candidates by all runs
TEST(Search, SpendsTheLeastThatKeepsTheError) {
  const Synthetic target;
  for (const double most : {4.0, 6.0, 9.0, 20.0}) {
    Order all = order_of({{2, most}}, 0);
    all.rungs = {64, 64};
    const Finding brute = found_by(target, all);
    const Finding found = found_by(target, order_of({{2, most}}, 0));
    EXPECT_TRUE(found.feasible);
    EXPECT_LE(found.standings[found.pick].rmse, most);
    EXPECT_EQ(found.standings[found.pick].takes[0], brute.standings[brute.pick].takes[0]) << most;
  }
}

/// Whom nobody beats of those that all runs judged, by the words of the definition.
std::vector<std::size_t> by_every_pair(const Finding& found, std::size_t runs) {
  std::vector<std::size_t> all;
  const auto& standings = found.standings;
  const auto beats = [](const Standing& a, const Standing& b) {
    const bool no_more = a.rmse <= b.rmse && a.takes[0] <= b.takes[0] && a.takes[1] <= b.takes[1];
    return no_more && (a.rmse < b.rmse || a.takes[0] < b.takes[0] || a.takes[1] < b.takes[1]);
  };
  for (std::size_t c = 0; c < standings.size(); ++c)
    if (standings[c].runs == runs && std::none_of(standings.begin(), standings.end(), [&](const Standing& s) {
          return s.runs == runs && beats(s, standings[c]);
        }))
      all.push_back(c);
  return all;
}

// claim    the frontier has whom nobody beats, all of them judged by as many runs, and nobody is left out for having
//          lost a halving: of time, area and error every candidate is unbeaten here, for one errs less only by more
// referee  every pair; all candidates by all runs
// twin     the finalists of halving alone are an eighth of them
TEST(Search, ComparesEqualRunsOnTheFrontier) {
  const Synthetic target;
  const Finding found = found_by(target, order_of({}, 2));
  for (const std::size_t c : found.frontier) EXPECT_EQ(found.standings[c].runs, 64U);
  std::vector<std::size_t> sorted = found.frontier;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, by_every_pair(found, 64));
  Order all = order_of({}, 2);
  all.rungs = {64, 64};
  const Finding brute = found_by(target, all);
  std::vector<std::size_t> whole = brute.frontier;
  std::sort(whole.begin(), whole.end());
  EXPECT_EQ(whole, by_every_pair(brute, 64));
  EXPECT_EQ(sorted, whole);
  EXPECT_GT(sorted.size(), 32U);
}

// claim    whoever collapses, while it is timed or in its runs, is marked and left out, and nobody else
// twin     an exploration in which all collapse has no answer
TEST(Search, LeavesOutWhoCollapses) {
  const auto cheapest = [](const Words& words) { return words[0] == "1"; };
  for (const bool timed : {true, false}) {
    const Synthetic target = timed ? Synthetic(cheapest) : Synthetic({}, cheapest);
    const Finding found = found_by(target, order_of({{2, 1000}}, 0));
    EXPECT_TRUE(found.feasible);
    EXPECT_EQ(target.a(found.pick), 2) << "the cheapest that stands";
    for (std::size_t c = 0; c < 64; ++c) EXPECT_EQ(found.standings[c].collapsed, target.a(c) == 1) << c;
    for (const std::size_t c : found.frontier) EXPECT_FALSE(found.standings[c].collapsed);
  }
  const auto everybody = [](const Words&) { return true; };
  EXPECT_THROW(found_by(Synthetic(everybody), order_of({}, 2)), Refusal);
  EXPECT_THROW(found_by(Synthetic({}, everybody), order_of({}, 2)), Refusal);
}

// twin    one that judges every candidate by one run alone loses the least time for some error
TEST(Search, NeedsMoreThanOneRun) {
  const Synthetic target;
  int worse = 0;
  for (const double most : {4.0, 6.0, 9.0, 20.0}) {
    Order few = order_of({{2, most}}, 0);
    few.rungs = {1, 1};
    Order all = few;
    all.rungs = {64, 64};
    const Finding brute = found_by(target, all);
    const Finding found = found_by(target, few);
    worse += found.standings[found.pick].takes[0] != brute.standings[brute.pick].takes[0] ? 1 : 0;
  }
  EXPECT_GT(worse, 0);
}

TEST(Search, NamesWhatBindsAndTheNearest) {
  const Synthetic target;
  const Finding found = found_by(target, order_of({{0, 0.5}, {2, 1000}}, 2));
  EXPECT_FALSE(found.feasible);
  EXPECT_EQ(found.broken, std::vector<std::size_t>{0});
  EXPECT_EQ(target.a(found.pick), 1) << "twice the deadline, the least there is";
  EXPECT_EQ(target.b(found.pick), 8) << "with the least error of those";
  EXPECT_EQ(found.standings.back().runs, 0U) << "sixteen times the deadline: not worth a run";
}

// claim    an exploration that was cut off goes on to the same findings, and finds nothing twice
TEST(Search, GoesOnWhereItWas) {
  const Order order = order_of({{0, 5}}, 2);
  const Synthetic target;
  Journal journal("", {});
  const Finding once = found_by(target, order, journal);
  const int ran = target.ran;
  const Finding again = found_by(target, order, journal);
  EXPECT_EQ(target.ran, ran);
  EXPECT_EQ(target.found, 64);
  EXPECT_EQ(again.pick, once.pick);
  EXPECT_EQ(again.frontier, once.frontier);
  for (std::size_t c = 0; c < 64; ++c) EXPECT_EQ(again.standings[c].rmse, once.standings[c].rmse);
  found_by(target, order_of({{0, 7}}, 2), journal);
  EXPECT_LT(target.ran - ran, ran) << "another budget makes the runs that are missing";
}

TEST(Search, IsTheSameOnAnyNumberOfThreads) {
  Order order = order_of({}, 2);
  const Finding two = found_by(Synthetic(), order);
  order.threads = 1;
  const Finding one = found_by(Synthetic(), order);
  EXPECT_EQ(two.pick, one.pick);
  EXPECT_EQ(two.frontier, one.frontier);
}

TEST(Search, StopsAtASignal) {
  const std::atomic<bool> stop{true};
  Journal journal("", {});
  const Synthetic target;
  EXPECT_THROW(search(
                   target, jury(), journal, order_of({}, 2), [](const char*, std::size_t, std::size_t) {}, stop),
               Refusal);
  EXPECT_EQ(target.ran, 0);
}

}  // namespace
}  // namespace mote::explore
