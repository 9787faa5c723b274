#include "mote/engine/stream.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mote {

void Latency::add(std::chrono::nanoseconds time) {
  largest_ = std::max(largest_, time);
  const auto ns = static_cast<std::uint64_t>(std::max<std::int64_t>(time.count(), 1));
  const auto octave = static_cast<std::size_t>(std::bit_width(ns) - 1);
  const std::uint64_t rest = ns - (std::uint64_t{1} << octave);  // below 2^octave
  const auto part = static_cast<std::size_t>(octave >= 4 ? rest >> (octave - 4) : rest << (4 - octave));
  ++counts_[octave * kPerOctave + part];
  ++steps_;
}

std::chrono::nanoseconds Latency::quantile(double level) const {
  std::uint64_t through = 0;
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    through += counts_[k];
    if (through == 0 || static_cast<double>(through) < level * static_cast<double>(steps_)) continue;
    const double upper =
        std::ldexp(1 + static_cast<double>(k % kPerOctave + 1) / kPerOctave, static_cast<int>(k / kPerOctave));
    return std::min(largest_, std::chrono::nanoseconds(static_cast<std::int64_t>(upper)));
  }
  return largest_;
}

Stream::Stream(std::unique_ptr<Filter> filter, std::span<const Quantity> states, std::span<const Column> columns)
    : filter_(std::move(filter)), moments_(states.size()) {
  for (const Column& column : columns) observations_ += column.input ? 0 : 1;
  for (const Quantity& state : states) angles_.push_back(state.angle);
  estimate_.states = moments_;
}

const StreamEstimate& Stream::step(Rows<double> rows) {
  const auto start = std::chrono::steady_clock::now();
  const bool observed = std::any_of(rows.begin(), rows.end(), [this](const Row<double>& row) {
    const auto last = row.present.begin() + static_cast<std::ptrdiff_t>(observations_);
    return std::find(row.present.begin(), last, true) != last;
  });
  const Step t = ++estimate_.t;
  estimate_.report = observed ? filter_->update(t, rows) : filter_->predict(t);
  for (std::size_t d = 0; d < moments_.size(); ++d) moments_[d] = filter_->moments(d, angles_[d]);
  if (observed) filter_->select(t, estimate_.report);
  latency_.add(std::chrono::steady_clock::now() - start);
  return estimate_;
}

}  // namespace mote
