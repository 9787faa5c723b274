// The task whose entrants are processes: ranks of a team, threads, and processes that share nothing.

#include <future>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "mote/app/bench/racers.hpp"
#include "mote/app/bench/task_list.hpp"
#include "mote/app/commands/hand_over.hpp"
#include "mote/app/files/table.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"

namespace mote::bench {
namespace {

constexpr Step kSteps = 100;
constexpr std::uint64_t kRecording = 1;   // seed
constexpr std::size_t kJudged = 100'000;  // particles of a judged run, so that every rank has blocks of its own
constexpr double kAlike = 0.25;

/// The recording that all filter, as a file.
struct Ground {
  ScratchFolder folder;
  std::string data = folder.file("data.csv");
};

/// Runs a command; its exit code and words to standard error are part of the refusal where it fails.
void run_or_refuse(const std::string& program, const std::vector<std::string>& words) {
  const OutsideEnd end = run_outside(program, words);
  if (end.error == 0 && end.code == 0) return;
  throw Refusal(
      ExitCode::kOutsideTool,
      {fmt::format("mote bench: {} {}", program, fmt::join(words, " ")), "", "a run that ends with exit code 0",
       fmt::format("{} and \"{}\"", end.code, end.err), "Run it alone to see what it lacks."});
}

/// How an entrant runs: words before those of `mote run`, words after them, and how many processes share the particles
/// without knowing of one another.
struct Manner {
  std::vector<std::string> before{}, after{};
  std::size_t apart = 1;
};

/// `mote run` in processes of its own, timed by its summary: the slowest where there are several.
class ProcessRacer final : public Racer {
 public:
  ProcessRacer(std::shared_ptr<const Ground> ground, Manner manner)
      : ground_(std::move(ground)), manner_(std::move(manner)) {}

  void prepare(std::size_t particles, std::uint64_t seed) override {
    particles_ = particles;
    seed_ = seed;
  }
  /// The means, those of several processes averaged.
  void run(std::vector<double>& answer) override {
    std::vector<std::future<void>> running;
    for (std::size_t k = 0; k < manner_.apart; ++k)
      running.push_back(std::async(std::launch::async, [this, k] { run_part(k); }));
    for (auto& part : running) part.get();
    seconds_ = 0;
    answer.assign(kSteps, 0.0);
    for (std::size_t k = 0; k < manner_.apart; ++k) take_result(k, answer);
  }
  double outside_seconds() const override { return seconds_; }
  double outside_bytes() const override { return kNaN; }

 private:
  std::size_t particles_of(std::size_t part) const {
    return particles_ / manner_.apart + (part < particles_ % manner_.apart ? 1 : 0);
  }
  std::string file(const std::string& name, std::size_t part) const {
    return results_.file(fmt::format("{}{}", part, name));
  }
  void run_part(std::size_t part) const {
    std::vector<std::string> words = manner_.before;
    words.insert(words.end(), {beside("mote"), "run", "ungm", "--data", ground_->data});
    words.insert(words.end(),
                 {"-n", std::to_string(particles_of(part)), "--seed", std::to_string(seed_ + 1000 * part)});
    words.insert(words.end(), {"--out", file("means.csv", part), "--summary", file("summary.json", part)});
    words.insert(words.end(), manner_.after.begin(), manner_.after.end());
    run_or_refuse(words.front(), {words.begin() + 1, words.end()});
  }
  void take_result(std::size_t part, std::vector<double>& answer) {
    const auto summary = nlohmann::json::parse(read_text(file("summary.json", part)));
    const double particle_steps = static_cast<double>(particles_of(part)) * kSteps;
    seconds_ = std::max(seconds_, 1e-9 * summary.at("ns_per_particle_step").get<double>() * particle_steps);
    const Table means = read_table(file("means.csv", part));
    const std::size_t column = means.column("x_mean").value();
    for (std::size_t t = 0; t < answer.size(); ++t)
      answer[t] += number_field(means, means.lines[t], column) / static_cast<double>(manner_.apart);
  }

  std::shared_ptr<const Ground> ground_;
  Manner manner_;
  ScratchFolder results_;
  std::size_t particles_ = 0;
  std::uint64_t seed_ = 1;
  double seconds_ = kNaN;
};

/// Why teams of so many ranks cannot be started here.
std::string why_no_team(std::size_t ranks) {
  const OutsideEnd end = run_outside("mpirun", {"-n", std::to_string(ranks), "true"});
  if (end.error != 0) return "mpirun is missing (Debian: apt-get install openmpi-bin)";
  if (end.code != 0) return fmt::format("`mpirun -n {} true` ends with exit code {}", ranks, end.code);
  return "";
}

}  // namespace

// claim    results do not depend on the number of threads, nor on that of ranks; K processes apart filter alike
// referee  one thread of one process
// design   100 000 particles; threads and ranks are equal bit by bit. What two filters of that many differ by, and one
//          and the mean of two of half as many, is 0.05 to 0.1; filters of 1000 particles differ by 0.7
// risk     none: the verdict is fixed
Task ranks_task(const TaskEntry& entry, std::size_t threads) {
  const std::string k = std::to_string(threads);
  auto ground = std::make_shared<Ground>();
  run_or_refuse(beside("mote"), {"simulate", "ungm", "--steps", std::to_string(kSteps), "--seed",
                                 std::to_string(kRecording), "--out", ground->data});
  const auto entrant = [&](const std::string& name, const std::string& meaning, const Manner& manner,
                           const std::string& why_not = {}) {
    return Entrant{name, meaning, 4 * sizeof(double), why_not,
                   [ground, manner] { return std::make_unique<ProcessRacer>(ground, manner); }};
  };
  Task task{entry.name, entry.meaning, Clock::kWall, kSteps, {}, {}};
  task.least_particles = threads * kBlock;
  task.entrants = {entrant("process", "one process, one thread", {{}, {"--threads", "1"}}),
                   entrant("threads x " + k, "one process with so many threads", {{}, {"--threads", k}}),
                   entrant("ranks x " + k, "so many ranks under mpirun, a thread each",
                           {{"mpirun", "-n", k}, {"--engine", "mpi"}}, why_no_team(threads)),
                   entrant("apart x " + k, "so many processes at a time that share nothing, 1/K of the particles each",
                           {{}, {"--threads", "1"}, threads})};
  task.judge = [alone = task.entrants.front(), apart = task.entrants.back().name](const Entrant& one) {
    const auto own = answer_of(one, kJudged, 1);
    const auto expected = answer_of(alone, kJudged, 1);
    if (one.name == apart)
      return Verdict{fmt::format("RMS difference of the means to one process's, {} particles", kJudged),
                     rms_between(own, expected), 0, kAlike};
    return Verdict{fmt::format("greatest difference of a mean to one process's, {} particles", kJudged),
                   greatest_between(own, expected), 0, 0};
  };
  return task;
}

}  // namespace mote::bench
