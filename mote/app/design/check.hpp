#pragma once
/// Predicted against measured: how well the figures hold that designs are chosen by.

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace mote {

/// One prediction beside what came of it, in one unit.
struct PredictionCheck {
  std::string what;
  double predicted = 0, measured = 0;
  double ratio = 0;  ///< measured over predicted; of several rounds their median
  double bound = 0;  ///< asked of |ratio - 1|

  bool keeps() const { return std::abs(ratio - 1) <= bound; }
};

/// Told after every measurement.
using CheckProgress = std::function<void()>;

/// How threads are checked.
struct ThreadsCheck {
  std::size_t particles = 20000;
  std::size_t most_threads = 1;
  int rounds = 7;
};

/// Time of a step of SISR on the SIMD engine, us, of the number of threads that the prediction says is the quickest:
/// for ungm, bearings and doa.
///
/// The prediction is a line through the times of half and of twice as many particles, on as many threads. A round
/// measures all three, each the quickest of three runs, so that a machine whose speed changes does so for all; ratios
/// are the rounds' medians.
std::vector<PredictionCheck> check_threads(const ThreadsCheck& check, const std::string& where,
                                           const CheckProgress& progress);
/// Measurements of that.
std::size_t measurements_of(const ThreadsCheck& check);

/// Cycles of the circuits of the growth model: a step of IMH by the latency law, a run of SISR by the golden model's
/// count; simulated clock by clock.
///
/// error   Refusal (kOutsideTool) without Verilator
std::vector<PredictionCheck> check_circuits(const std::string& where, const CheckProgress& progress);
/// Measurements of that.
std::size_t circuits_checked();

/// Milliseconds of a step on clusters, by the exact schedule of its blocks and messages; simulated by SimGrid.
///
/// error   Refusal (kOutsideTool) without SimGrid
std::vector<PredictionCheck> check_clusters(const std::string& where, const CheckProgress& progress);
/// Measurements of that.
std::size_t clusters_checked();

}  // namespace mote
