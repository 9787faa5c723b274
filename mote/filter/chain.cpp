#include "mote/filter/chain.hpp"

#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote {
namespace {

/// One chain in motion.
class Chain {
 public:
  Chain(std::span<const double> log_weights, std::span<const double> log_uniforms, ChainReport& report)
      : log_weights_(log_weights), log_uniforms_(log_uniforms), report_(report) {}

  void start(std::size_t proposal) {
    at_ = start_ = proposal;
    started_ = true;
  }
  std::size_t visit(std::size_t proposal) {
    if (!started_) start(proposal);
    if (proposal == start_) return at_;
    ++report_.offered;
    // a current state of weight zero gives way to any other of positive weight
    const bool accepted = log_weights_[at_] == -kInfinity
                              ? log_weights_[proposal] > -kInfinity
                              : log_uniforms_[proposal] < log_weights_[proposal] - log_weights_[at_];
    if (accepted) {
      ++report_.accepted;
      at_ = proposal;
    }
    return at_;
  }

 private:
  std::span<const double> log_weights_, log_uniforms_;
  ChainReport& report_;
  std::size_t at_ = 0, start_ = 0;
  bool started_ = false;
};

}  // namespace

ChainReport run_chains(const ChainLayout& layout, std::span<const double> log_weights,
                       std::span<const double> log_uniforms, std::span<const Index> starts, std::span<Index> picks) {
  ChainReport report;
  const Cut drawn(layout.draws, layout.chains);
  const Cut kept_by(layout.kept, layout.chains);
  for (std::size_t k = 0; k < layout.chains; ++k) {
    Chain chain(log_weights, log_uniforms, report);
    if (!starts.empty()) chain.start(starts[k]);
    for (std::size_t b = 0; b < layout.burn_in; ++b) chain.visit(layout.draws + k * layout.burn_in + b);
    const std::size_t stop = drawn.begin(k + 1);
    const std::size_t kept_first = kept_by.begin(k);
    const std::size_t kept = kept_by.begin(k + 1) - kept_first;
    for (std::size_t j = drawn.begin(k); j < stop; ++j) {
      const std::size_t at = chain.visit(j);
      if (j + kept >= stop) picks[kept_first + (j + kept - stop)] = static_cast<Index>(at);
    }
  }
  return report;
}

std::size_t burn_in_for(double mean_weight, double largest_weight, double distance, std::size_t most) {
  if (!(mean_weight < largest_weight)) return 0;
  const double n = std::ceil(std::log(distance) / std::log1p(-mean_weight / largest_weight));
  return n < static_cast<double>(most) ? static_cast<std::size_t>(n) : most;
}

}  // namespace mote
