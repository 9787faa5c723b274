#include "mote/hardware/machine/architecture.hpp"

#include <algorithm>
#include <bit>

#include "mote/hardware/filters/sisr.hpp"

namespace mote::hardware {
namespace {

template <class Filter>
class GoldenOf final : public Golden {
 public:
  GoldenOf(const Arithmetic& arithmetic, std::uint64_t seed) : filter_(arithmetic, seed) {}

  void start(const RunRegisters& registers) override {
    if constexpr (requires { filter_.start(registers); })
      filter_.start(registers);
    else
      filter_.start(registers.particles);
  }
  Estimate step(Observed observed) override { return filter_.step(observed); }
  const Particles& set() const override { return filter_.set(); }
  std::uint64_t cycles() const override { return filter_.cycles(); }

 private:
  Filter filter_;
};

template <class Filter>
std::unique_ptr<Golden> golden_of(const Arithmetic& arithmetic, std::uint64_t seed) {
  return std::make_unique<GoldenOf<Filter>>(arithmetic, seed);
}

const Register kParticles{"n", "N, particles, from 1", false, [](const RunRegisters& r) { return r.particles; }};
const Register kDraws{"draws", "Q, proposals beside the burn-in, at least N", false,
                      [](const RunRegisters& r) { return r.draws; }};
const Register kBurnIn{"burn_in", "N_b, proposals that the chain forgets", false,
                       [](const RunRegisters& r) { return r.burn_in; }};
const Register kChainMean{"chain_mean", "1: the mean over the kept states, 0: over all weighted proposals", true,
                          [](const RunRegisters& r) { return std::uint32_t{r.chain_mean}; }};

unsigned bits_for(std::uint32_t count) { return static_cast<unsigned>(ceil_log2(count)); }

/// A chain keeps `most` particles of up to 2^at proposals.
Capacity chain_capacity(const RunRegisters& r) {
  const std::uint32_t most = std::max(2U, std::bit_ceil(r.particles));
  return {std::max(bits_for(r.proposals()), bits_for(most)), most};
}

Capacity cloud_capacity(const RunRegisters& r) {
  const unsigned at = std::max(2U, bits_for(r.particles));
  return {at, 1U << at};
}

std::vector<Parameter> chain_parameters(const Capacity& c) { return {parameter("Most", static_cast<int>(c.most))}; }

std::vector<Parameter> no_parameters(const Capacity&) { return {}; }

std::string chain_range(const Capacity& c) {
  return "1 <= n_i <= " + std::to_string(c.most) +
         ", n_i <= draws_i, draws_i + burn_in_i <= " + std::to_string(1U << c.at);
}

std::string cloud_range(const Capacity& c) { return "1 <= n_i <= " + std::to_string(c.most); }

}  // namespace

const std::vector<Architecture>& architectures() {
  static const std::vector<Architecture> all{
      {"imh",
       "independent Metropolis-Hastings, one chain, parents at random",
       "mote_imh",
       "mote/hardware/filters/imh.hpp",
       {kParticles, kDraws, kBurnIn, kChainMean},
       true,
       5,
       chain_parameters,
       chain_range,
       chain_capacity,
       golden_of<Imh>},
      {"sisr",
       "bootstrap filter, one lane, systematic resampling of a step beside the next one's proposals",
       "mote_sisr",
       "mote/hardware/filters/sisr.hpp",
       {kParticles},
       false,
       8,
       no_parameters,
       cloud_range,
       cloud_capacity,
       golden_of<Sisr>},
  };
  return all;
}

}  // namespace mote::hardware
