#include "mote/hardware/filters/resampler.hpp"

#include "mote/hardware/filters/offspring.hpp"
#include "mote/hardware/filters/residual.hpp"
#include "mote/hardware/filters/roulette.hpp"

namespace mote::hardware {
namespace {

/// The walk over ends, and the parents that it finds.
class SystematicWalk final : public ParentWalk {
 public:
  SystematicWalk(const Weighed& weighed, const Offspring& offspring, unsigned lanes, std::uint32_t uniform,
                 unsigned product_latency)
      : lanes_(lanes),
        ends_(offspring.ends(weighed.weights, weighed.total, uniform)),
        parents_(parents_of(ends_)),
        next_(parents_.begin()),
        walk_(ends_, lanes, weighed.written.back(), product_latency) {}

  bool shows() const override { return walk_.shows(); }
  bool cycle(bool ready, std::vector<std::uint32_t>& parents) override {
    if (!walk_.cycle(ready)) return false;
    parents.insert(parents.end(), next_, next_ + lanes_);
    next_ += lanes_;
    return true;
  }
  std::uint64_t now() const override { return walk_.now(); }

 private:
  std::ptrdiff_t lanes_;
  std::vector<std::uint32_t> ends_, parents_;
  std::vector<std::uint32_t>::const_iterator next_;
  ChildrenWalk walk_;
};

}  // namespace

std::unique_ptr<ParentWalk> ResamplerWords::walk(const Weighed& weighed, const Formats& formats, unsigned lanes) {
  const Offspring offspring{formats.weight_bits, formats.count_bits};
  const unsigned product = formats.product_latency;
  if (scheme_ == Resampler::kSystematic)
    return std::make_unique<SystematicWalk>(weighed, offspring, lanes, step_, product);
  if (scheme_ == Resampler::kResidualSystematic)
    return std::make_unique<ResidualWalk>(weighed, offspring, step_, product);
  return std::make_unique<RouletteWalk>(weighed, formats.count_bits, words_, product);
}

}  // namespace mote::hardware
