#pragma once
/// A filter inside somebody's loop: fed as observations arrive, estimates at once, no memory asked for on the way.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mote/filter/filter.hpp"

namespace mote {

/// Times of steps, kept as a histogram of sixteen classes per octave.
///
/// unit    ns; quantiles are right within 1/16, the largest exactly
/// cost    no allocation
class Latency {
 public:
  void add(std::chrono::nanoseconds time);
  std::uint64_t steps() const { return steps_; }
  /// The time that a share `level` of the steps kept within; 0 before any step.
  std::chrono::nanoseconds quantile(double level) const;
  std::chrono::nanoseconds largest() const { return largest_; }

 private:
  static constexpr std::size_t kPerOctave = 16;
  std::array<std::uint64_t, 64 * kPerOctave> counts_{};
  std::uint64_t steps_ = 0;
  std::chrono::nanoseconds largest_{0};
};

/// What a step of a stream says.
struct StreamEstimate {
  Step t = 0;
  StepReport report;
  std::span<const Moments> states;  ///< one a component, valid until the next step
};

/// A filter in motion, one step a call.
///
///   Stream stream(make_vector_filter(model, plan, "loop"), model.states(), model.columns());
///   const StreamEstimate& now = stream.step(rows);   // now.states[0].mean, now.states[0].sd
///
/// shape   rows of this step's measurements; none, or no observation seen: the step is predicted only
/// error   none; a collapsed step is reported
/// cost    that of the filter; allocates nothing of its own
class Stream {
 public:
  Stream(std::unique_ptr<Filter> filter, std::span<const Quantity> states, std::span<const Column> columns);

  const StreamEstimate& step(Rows<double> rows);
  /// Times of the steps so far, from the call to the estimates and the selection that prepares the next step.
  const Latency& latency() const { return latency_; }

 private:
  std::unique_ptr<Filter> filter_;
  std::vector<bool> angles_;
  std::size_t observations_ = 0;  // columns, before the inputs
  std::vector<Moments> moments_;
  StreamEstimate estimate_;
  Latency latency_;
};

}  // namespace mote
