#include "mote/filter/chain.hpp"

#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote {

Chains::Chains(const ChainLayout& layout, std::span<const double> log_weights, std::span<const double> log_uniforms,
               std::span<const Index> starts, std::span<Index> picks)
    : layout_(layout),
      drawn_(layout.draws, layout.chains),
      kept_by_(layout.kept, layout.chains),
      log_weights_(log_weights),
      log_uniforms_(log_uniforms),
      picks_(picks),
      chains_(layout.chains) {
  for (std::size_t k = 0; k < starts.size(); ++k) chains_[k].at = chains_[k].start = starts[k];
}

std::size_t Chains::visit(Chain& chain, std::size_t proposal) const {
  if (chain.start == Chain::kNowhere) chain.at = chain.start = proposal;
  if (proposal == chain.start) return chain.at;
  ++chain.report.offered;
  // a current state of weight zero gives way to any other of positive weight
  const bool accepted = log_weights_[chain.at] == -kInfinity
                            ? log_weights_[proposal] > -kInfinity
                            : log_uniforms_[proposal] < log_weights_[proposal] - log_weights_[chain.at];
  if (accepted) {
    ++chain.report.accepted;
    chain.at = proposal;
  }
  return chain.at;
}

void Chains::take(std::size_t first, std::size_t last) {
  std::size_t j = first;
  for (; j < std::min(last, layout_.draws);) {
    const std::size_t k = drawn_.part_of(j);
    const std::size_t stop = drawn_.begin(k + 1);
    const std::size_t kept_first = kept_by_.begin(k);
    const std::size_t kept = kept_by_.begin(k + 1) - kept_first;
    for (const std::size_t end = std::min(stop, last); j < end; ++j) {
      const std::size_t at = visit(chains_[k], j);
      if (j + kept >= stop) picks_[kept_first + (j + kept - stop)] = static_cast<Index>(at);
    }
  }
  for (; j < last; ++j) visit(chains_[(j - layout_.draws) / layout_.burn_in], j);
}

std::array<std::span<std::byte>, 2> Chains::outcome(std::size_t first, std::size_t last) {
  const std::size_t kept = kept_by_.begin(first);
  return {std::as_writable_bytes(std::span(chains_).subspan(first, last - first)),
          std::as_writable_bytes(picks_.subspan(kept, kept_by_.begin(last) - kept))};
}

ChainReport Chains::report() const {
  ChainReport all;
  for (const Chain& chain : chains_) {
    all.offered += chain.report.offered;
    all.accepted += chain.report.accepted;
  }
  return all;
}

ChainReport run_chains(const ChainLayout& layout, std::span<const double> log_weights,
                       std::span<const double> log_uniforms, std::span<const Index> starts, std::span<Index> picks) {
  Chains chains(layout, log_weights, log_uniforms, starts, picks);
  chains.take(layout.draws, layout.proposals());
  chains.take(0, layout.draws);
  return chains.report();
}

std::size_t burn_in_for(double mean_weight, double largest_weight, double distance, std::size_t most) {
  if (!(mean_weight < largest_weight)) return 0;
  const double n = std::ceil(std::log(distance) / std::log1p(-mean_weight / largest_weight));
  return n < static_cast<double>(most) ? static_cast<std::size_t>(n) : most;
}

}  // namespace mote
