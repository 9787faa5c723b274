#include "mote/hardware/filters/resampler.hpp"

#include "mote/hardware/filters/residual.hpp"
#include "mote/hardware/filters/roulette.hpp"
#include "mote/hardware/filters/systematic.hpp"

namespace mote::hardware {
namespace {

/// The walk of mote_systematic with the sums that it goes along.
class OwnSystematicWalk final : public ParentWalk {
 public:
  OwnSystematicWalk(const Weighed& weighed, std::uint32_t uniform)
      : sums_(cumulative_sums(weighed.weights)),
        walk_(sums_, weighed.total, uniform, weighed.written, weighed.written.back() - 3) {}

  bool shows() const override { return walk_.shows(); }
  bool cycle(bool ready, std::uint32_t& parent) override { return walk_.cycle(ready, parent); }
  std::uint64_t now() const override { return walk_.now(); }

 private:
  std::vector<std::uint64_t> sums_;
  SystematicWalk walk_;
};

}  // namespace

std::unique_ptr<ParentWalk> ResamplerWords::walk(const Weighed& weighed, unsigned weight_bits, unsigned count_bits) {
  if (scheme_ == Resampler::kSystematic) return std::make_unique<OwnSystematicWalk>(weighed, step_);
  if (scheme_ == Resampler::kResidualSystematic)
    return std::make_unique<ResidualWalk>(weighed, weight_bits, count_bits, step_);
  return std::make_unique<RouletteWalk>(weighed, count_bits, words_);
}

}  // namespace mote::hardware
