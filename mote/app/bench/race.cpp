#include "mote/app/bench/race.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <limits>

#include <fmt/format.h>
#include <malloc.h>

#include "mote/base/refusal.hpp"

namespace mote::bench {
namespace {

constexpr std::size_t kLeastWork = 2'000'000;  // particle-steps of a turn

double seconds_on(Clock clock) {
  timespec now{};
  clock_gettime(clock == Clock::kThread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Bytes this program holds from the allocator.
double held_bytes() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

void refuse_if(bool stop, const Rules& rules, const Task& task) {
  if (stop)
    throw Refusal(ExitCode::kInterrupted,
                  fmt::format("{}: {}: interrupted; no file was written.", rules.where, task.name));
}

/// Judges, or says that a fault is mote's own: exit code 1.
Verdict checked(const Task& task, const Entrant& entrant, const Rules& rules) {
  Verdict verdict = task.judge(entrant);
  if (verdict.right()) return verdict;
  throw Refusal(static_cast<ExitCode>(1),
                {fmt::format("{}: {}: {}", rules.where, task.name, entrant.name), verdict.measure,
                 fmt::format("{:.4g} to {:.4g}", verdict.low, verdict.high), fmt::format("{:.4g}", verdict.value),
                 "Its answer is wrong, so nothing was timed; please report it."});
}

/// An entrant at one number of particles.
struct Lane {
  const Entrant* entrant;
  std::unique_ptr<Racer> racer;
  double memory = kNaN;
  std::vector<double> rounds{};
  std::vector<double> predicted{};  // likewise, where there is a law
};

/// Seconds of one run.
double one_run(Racer& racer, Clock clock, std::size_t particles, std::uint64_t seed, std::vector<double>& answer) {
  racer.prepare(particles, seed);
  const double start = seconds_on(clock);
  racer.run(answer);
  const double seconds = seconds_on(clock) - start;
  return std::isnan(racer.outside_seconds()) ? seconds : racer.outside_seconds();
}

/// A lane with its racer warm and its memory measured.
Lane warmed(const Entrant& entrant, Clock clock, std::size_t particles, std::vector<double>& answer) {
  const double before = held_bytes();
  Lane lane{&entrant, entrant.make()};
  one_run(*lane.racer, clock, particles, 1, answer);
  const double inside = held_bytes() - before;
  lane.memory = std::isnan(lane.racer->outside_seconds()) ? inside : lane.racer->outside_bytes();
  if (!(lane.memory > 0)) lane.memory = kNaN;
  return lane;
}

void take_turn(Lane& lane, const Task& task, std::size_t particles, std::uint64_t round, std::vector<double>& answer) {
  const std::size_t work = particles * task.steps;
  const std::size_t runs = task.most_particles > 0 ? 1 : (kLeastWork + work - 1) / work;
  double seconds = 0;
  for (std::size_t k = 0; k < runs; ++k) seconds += one_run(*lane.racer, task.clock, particles, round + 1, answer);
  lane.rounds.push_back(1e9 * seconds / static_cast<double>(runs * work));
  if (lane.entrant->predicted)
    lane.predicted.push_back(1e9 * lane.entrant->predicted(particles) / static_cast<double>(work));
}

Result result_of(const Lane& lane, std::size_t particles, const Lane& first, const Lane* limit) {
  const Ratio none{kNaN, {kNaN, kNaN}};
  const bool has_law = !lane.predicted.empty();
  return {lane.entrant->name,
          particles,
          lane.rounds,
          spread_of(lane.rounds),
          lane.entrant->bytes,
          lane.memory,
          paired_ratio(lane.rounds, first.rounds),
          limit == nullptr ? none : paired_ratio(limit->rounds, lane.rounds),
          has_law ? compare::median(lane.predicted) : kNaN,
          has_law ? paired_ratio(lane.rounds, lane.predicted) : none};
}

void race_at(const Task& task, const std::vector<const Entrant*>& present, std::size_t particles, const Rules& rules,
             const std::function<void()>& advance, Outcome& outcome) {
  std::vector<double> answer;
  std::vector<Lane> lanes;
  for (const Entrant* entrant : present) {
    refuse_if(rules.stop, rules, task);
    lanes.push_back(warmed(*entrant, task.clock, particles, answer));
  }
  for (std::size_t round = 0; round < rules.repeats; ++round)
    for (Lane& lane : lanes) {
      refuse_if(rules.stop, rules, task);
      take_turn(lane, task, particles, round, answer);
      advance();
    }
  const auto limit =
      std::find_if(lanes.begin(), lanes.end(), [](const Lane& lane) { return lane.entrant->name == "limit"; });
  for (const Lane& lane : lanes)
    if (const auto stages = lane.racer->stages(); stages && outcome.results.empty())
      outcome.stages.emplace_back(lane.entrant->name, *stages);
  for (const Lane& lane : lanes)
    outcome.results.push_back(result_of(lane, particles, lanes.front(), limit == lanes.end() ? nullptr : &*limit));
}

/// The numbers of particles to race at, each once.
std::vector<std::size_t> raced_at(const Task& task, std::vector<std::size_t> asked) {
  const std::size_t most = task.most_particles == 0 ? std::numeric_limits<std::size_t>::max() : task.most_particles;
  for (std::size_t& n : asked) n = std::clamp(n, task.least_particles, most);
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  return asked;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - std::floor(place));
  };
  return {at(0.5), at(0.25), at(0.75)};
}

Ratio paired_ratio(std::span<const double> above, std::span<const double> below) {
  std::vector<double> ratios;
  for (std::size_t r = 0; r < above.size(); ++r) ratios.push_back(above[r] / below[r]);
  const auto median_at = [&](std::span<const std::size_t> places) {
    std::vector<double> chosen;
    for (const std::size_t place : places) chosen.push_back(ratios[place]);
    return compare::median(std::move(chosen));
  };
  return {compare::median(ratios), compare::bootstrap({1, ratios.size()}, median_at)};
}

Outcome race(const Task& task, const Rules& rules) {
  Outcome outcome{task.name, task.meaning, task.clock, task.steps, {}, {}, {}, {}};
  std::vector<const Entrant*> present;
  for (const Entrant& entrant : task.entrants) {
    refuse_if(rules.stop, rules, task);
    if (!entrant.why_not.empty()) {
      outcome.absent.push_back({entrant.name, entrant.why_not});
      continue;
    }
    outcome.checks.push_back({entrant.name, checked(task, entrant, rules)});
    present.push_back(&entrant);
  }
  const auto numbers = raced_at(task, rules.particles);
  const std::size_t all = present.size() * rules.repeats * numbers.size();
  std::size_t done = 0;
  for (const std::size_t particles : numbers)
    race_at(
        task, present, particles, rules, [&] { rules.progress(++done, all); }, outcome);
  return outcome;
}

}  // namespace mote::bench
