#include "mote/app/bench/race.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "mote/app/bench/racers.hpp"
#include "mote/app/bench/task_list.hpp"
#include "mote/base/refusal.hpp"

namespace mote::bench {
namespace {

const std::atomic<bool> kNever{false};

Rules rules_of(std::vector<std::size_t> particles, std::size_t repeats) {
  return {"test", std::move(particles), repeats, [](std::size_t, std::size_t) {}, kNever};
}

/// Notes its turns in a shared list.
class Noted final : public Racer {
 public:
  Noted(std::string name, std::vector<std::string>& turns) : name_(std::move(name)), turns_(&turns) {}
  void prepare(std::size_t, std::uint64_t) override {}
  void run(std::vector<double>&) override { turns_->push_back(name_); }

 private:
  std::string name_;
  std::vector<std::string>* turns_;
};

Task noted_task(std::vector<std::string>& turns) {
  Task task{"noted", "two that note their turns", Clock::kThread, 1000, {}, {}};
  for (const std::string name : {"a", "b"})
    task.entrants.push_back({name, "", 8, "", [name, &turns] { return std::make_unique<Noted>(name, turns); }});
  task.judge = [](const Entrant&) { return Verdict{"nothing", 1, 0, 2}; };
  return task;
}

TEST(Race, TakesTurnsAfterAWarmUp) {
  std::vector<std::string> turns;
  const Outcome outcome = race(noted_task(turns), rules_of({2000}, 2));
  EXPECT_EQ(turns, (std::vector<std::string>{"a", "b", "a", "b", "a", "b"}));
  ASSERT_EQ(outcome.results.size(), 2U);
  EXPECT_EQ(outcome.results[1].rounds.size(), 2U);
  EXPECT_EQ(outcome.checks.size(), 2U);
  EXPECT_TRUE(std::isnan(outcome.results[0].of_limit.value)) << "there is no limit";
}

TEST(Race, RepeatsShortRunsWithinATurn) {
  std::vector<std::string> turns;
  race(noted_task(turns), rules_of({50}, 1));
  EXPECT_EQ(turns.size(), 2 + 2 * 40U) << "40 runs of 50 000 particle-steps";
}

TEST(Race, NeverTimesAWrongAnswer) {
  std::vector<std::string> turns;
  Task task = noted_task(turns);
  task.judge = [](const Entrant& entrant) { return Verdict{"the answer", entrant.name == "b" ? 3.0 : 1.0, 0, 2}; };
  try {
    race(task, rules_of({1000}, 2));
    FAIL() << "it was timed";
  } catch (const Refusal& refusal) {
    EXPECT_EQ(static_cast<int>(refusal.code()), 1);
    EXPECT_STREQ(refusal.what(),
                 "test: noted: b: the answer: expected 0 to 2, got 3. Its answer is wrong, so nothing was timed; "
                 "please report it.");
  }
  EXPECT_TRUE(turns.empty());
}

TEST(Race, NaNIsWrong) { EXPECT_FALSE((Verdict{"", std::nan(""), 0, 2}.right())); }

TEST(Race, LeavesOutWhoCannotRun) {
  std::vector<std::string> turns;
  Task task = noted_task(turns);
  task.entrants[0].why_not = "it is ill";
  const Outcome outcome = race(task, rules_of({2000}, 1));
  ASSERT_EQ(outcome.absent.size(), 1U);
  EXPECT_EQ(outcome.absent[0].why, "it is ill");
  EXPECT_EQ(outcome.results.size(), 1U);
  EXPECT_EQ(turns, (std::vector<std::string>{"b", "b"}));
}

TEST(Race, EndsWhenItIsTold) {
  std::vector<std::string> turns;
  const std::atomic<bool> stop{true};
  try {
    race(noted_task(turns), {"test", {1000}, 2, [](std::size_t, std::size_t) {}, stop});
    FAIL() << "nothing stopped it";
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kInterrupted);
  }
}

TEST(Spread, IsTheMedianAndTheQuartiles) {
  const Spread spread = spread_of({5, 1, 4, 2, 3});
  EXPECT_EQ(spread.median, 3);
  EXPECT_EQ(spread.low, 2);
  EXPECT_EQ(spread.high, 4);
  EXPECT_EQ(spread_of({1, 2}).median, 1.5);
  EXPECT_EQ(spread_of({7}).high, 7);
}

TEST(PairedRatio, ForgetsWhatHitsBothAlike) {
  const std::vector<double> a{1, 10, 2, 8, 3};
  const std::vector<double> b{2, 20, 4, 16, 6};
  const Ratio ratio = paired_ratio(a, b);
  EXPECT_EQ(ratio.value, 0.5);
  EXPECT_EQ(ratio.interval.low, 0.5);
  EXPECT_EQ(ratio.interval.high, 0.5);
  EXPECT_TRUE(std::isnan(paired_ratio({a.data(), 1}, {b.data(), 1}).interval.low));
}

Task task_named(const std::string& name) {
  for (const TaskEntry& entry : tasks())
    if (entry.name == name) return entry.make(entry, 2);
  throw std::logic_error("no task " + name);
}

/// A filter of ungm that takes another phase for the drift's cosine.
Entrant out_of_phase() {
  auto course = std::make_shared<Course>(*simulated_course("ungm", 100, 1));
  course->model = find_model("ungm", "test").make(Settings("test", {"omega=1.21"}), std::vector<std::string>{});
  return filter_entrant("twin", course, plan_of(Engine::kReference, Precision::kDouble));
}

// claim    the judge of the growth model passes who filters it and fails who takes omega = 1.21 for 1.2
// referee  the exact grid, in the judge
// design   the judge's own 20 runs, fixed seeds
// risk     none: the verdicts are fixed
TEST(Judges, TellAFilterFromOneThatIsOutOfPhase) {
  const Task task = task_named("ungm-double");
  EXPECT_FALSE(task.judge(out_of_phase()).right()) << "the twin";
  for (const Entrant& entrant : task.entrants)
    if (entrant.why_not.empty()) {
      const Verdict verdict = task.judge(entrant);
      EXPECT_TRUE(verdict.right()) << entrant.name << ' ' << verdict.value;
    }
}

/// Gives every particle one child, whatever its weight.
class OneEach final : public Racer {
 public:
  void prepare(std::size_t particles, std::uint64_t) override { particles_ = particles; }
  void run(std::vector<double>& answer) override {
    answer.resize(particles_);
    std::iota(answer.begin(), answer.end(), 0.0);
  }

 private:
  std::size_t particles_ = 0;
};

TEST(Judges, TellAFairSchemeFromOneWithoutWeights) {
  const Task task = task_named("resample");
  const Entrant twin{"twin", "", 0, "", [] { return std::make_unique<OneEach>(); }};
  EXPECT_FALSE(task.judge(twin).right());
  for (const Entrant& entrant : task.entrants) EXPECT_TRUE(task.judge(entrant).right()) << entrant.name;
}

}  // namespace
}  // namespace mote::bench
