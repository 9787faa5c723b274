#include <array>

#include <fmt/format.h>

#include "mote/app/design/check.hpp"
#include "mote/app/simulated/sweep.hpp"

namespace mote {
namespace {

using namespace simulated;

/// One of the papers' settings, or of docs/cluster.md.
struct Setting {
  const char *name, *platform;
  FilterKind filter;
  StageTimes times;
  std::size_t particles, dimensions;
  std::array<std::size_t, 3> workers;  ///< proposers, or weighers beside one; ranks
  enum { kWeighers, kProposers, kRanks } kind;
};

// IMH-OPT's stage times, 8 : 1100 : 1 us of the visual tracker and 19.2 : 1 : 7 of the growth model, a unit taken for
// 10 us as docs/cluster.md does
constexpr StageTimes kVisual{8e-6, 1.1e-3, 1e-6};
constexpr StageTimes kGrowth{192e-6, 10e-6, 70e-6};
constexpr StageTimes kParticle{5e-9, 0, 0};

constexpr double kClusterBound = 0.1;

constexpr std::array kSettings{
    Setting{"visual, imh", "red", FilterKind::kImh, kVisual, 840, 6, {1, 3, 6}, Setting::kWeighers},
    Setting{"visual, sisr", "red", FilterKind::kSisr, kVisual, 840, 6, {1, 3, 6}, Setting::kWeighers},
    Setting{"growth, imh", "red", FilterKind::kImh, kGrowth, 840, 1, {1, 2, 3}, Setting::kProposers},
    Setting{"growth, sisr", "red", FilterKind::kSisr, kGrowth, 840, 1, {1, 2, 3}, Setting::kProposers},
    Setting{"growth, imh", "ideal", FilterKind::kImh, kGrowth, 840, 1, {1, 3, 8}, Setting::kProposers},
    Setting{
        "a million a rank, sisr", "modern", FilterKind::kSisr, kParticle, 1'000'000, 1, {1, 4, 16}, Setting::kRanks},
    Setting{"20000 a rank, sisr", "modern", FilterKind::kSisr, kParticle, 20'000, 1, {1, 4, 16}, Setting::kRanks},
};

std::vector<SweepRun> runs_of(const Setting& s, const std::string& where, const CheckProgress& progress) {
  Workload work;
  work.filter = s.filter;
  work.by_stages = s.kind != Setting::kRanks;
  work.particles = s.particles;
  work.times = s.times;
  work.dimensions = s.dimensions;
  work.ess_share = 0.4;
  work.steps = work.by_stages ? 4 : 40;  // short ones: the barrier at whose end the clock is read counts in them
  const Platform platform = platform_from(s.platform, where);
  const std::vector<std::size_t> workers(s.workers.begin(), s.workers.end());
  if (s.kind == Setting::kRanks) return data_parallel_sweep(platform, work, workers, where, progress);
  const std::vector<std::size_t> one{1};
  const bool weighers = s.kind == Setting::kWeighers;
  return stage_parallel_sweep(platform, work, weighers ? one : workers, weighers ? workers : one, where, progress);
}

}  // namespace

std::size_t clusters_checked() { return kSettings.size() * kSettings.front().workers.size(); }

std::vector<PredictionCheck> check_clusters(const std::string& where, const CheckProgress& progress) {
  check_tools(where);
  constexpr std::array<const char*, 3> kNames{"R_w", "R_p", "ranks"};
  std::vector<PredictionCheck> all;
  for (const Setting& s : kSettings) {
    const auto runs = runs_of(s, where, progress);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const double predicted = runs[k].predicted_seconds.value();
      all.push_back({fmt::format("{} on {}, {} = {}: a step, ms", s.name, s.platform,
                                 kNames[static_cast<std::size_t>(s.kind)], s.workers[k]),
                     1e3 * predicted, 1e3 * runs[k].seconds_per_step, runs[k].seconds_per_step / predicted,
                     kClusterBound});
    }
  }
  return all;
}

}  // namespace mote
