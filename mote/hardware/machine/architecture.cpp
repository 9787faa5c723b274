#include "mote/hardware/machine/architecture.hpp"

#include <algorithm>
#include <bit>

#include "mote/hardware/filters/sisr.hpp"

namespace mote::hardware {
namespace {

template <class Filter>
class GoldenOf final : public Golden {
 public:
  template <class... How>
  explicit GoldenOf(const How&... how) : filter_(how...) {}

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

std::unique_ptr<Golden> golden_chains(const Arithmetic& arithmetic, std::uint64_t seed, const Capacity& capacity) {
  return std::make_unique<GoldenOf<Imh>>(arithmetic, seed, 0,
                                         ImhLanes{capacity.lanes, Parents::kBanked, false, capacity.overlapped});
}

std::unique_ptr<Golden> golden_chain(const Arithmetic& arithmetic, std::uint64_t seed, const Capacity& capacity) {
  return std::make_unique<GoldenOf<Imh>>(arithmetic, seed, 0,
                                         ImhLanes{capacity.lanes, Parents::kBanked, true, capacity.overlapped});
}

Arithmetic counting(Arithmetic arithmetic, const Capacity& capacity) {
  arithmetic.formats.count_bits = capacity.at;
  return arithmetic;
}

std::unique_ptr<Golden> golden_cloud(const Arithmetic& arithmetic, std::uint64_t seed, const Capacity& capacity) {
  return std::make_unique<GoldenOf<Sisr>>(counting(arithmetic, capacity), seed, 0, capacity.lanes);
}

std::unique_ptr<Golden> golden_loops(const Arithmetic& arithmetic, std::uint64_t seed, const Capacity& capacity) {
  return std::make_unique<GoldenOf<Sisr>>(counting(arithmetic, capacity), seed, 0, PlainLoops{});
}

const Register kParticles{"n", "N, particles, from 1", false, [](const RunRegisters& r) { return r.particles; }};
const Register kDraws{"draws", "Q, proposals beside the burn-in, at least N", false,
                      [](const RunRegisters& r) { return r.draws; }};
const Register kBurnIn{"burn_in", "N_b, proposals that the chain forgets", false,
                       [](const RunRegisters& r) { return r.burn_in; }};
const Register kChainMean{"chain_mean", "1: the mean over the kept states, 0: over all weighted proposals", true,
                          [](const RunRegisters& r) { return std::uint32_t{r.chain_mean}; }};

unsigned bits_for(std::uint32_t count) { return static_cast<unsigned>(ceil_log2(count)); }

/// Chains keep `most` particles of up to 2^at proposals.
Capacity chain_capacity(const RunRegisters& r, unsigned lanes) {
  const std::uint32_t most = std::max(2U, std::bit_ceil(r.particles));
  return {std::max(bits_for(r.draws + lanes * r.burn_in), bits_for(most)), most, lanes};
}

/// One chain before all lanes burns in once, by whole rows.
Capacity chain_of_pairs_capacity(const RunRegisters& r, unsigned lanes) {
  const std::uint32_t most = std::max(2U, std::bit_ceil(r.particles));
  return {std::max(bits_for(r.draws + (r.burn_in + lanes - 1) / lanes * lanes), bits_for(most)), most, lanes};
}

Capacity cloud_capacity(const RunRegisters& r, unsigned lanes) {
  const unsigned at = std::max(6U, bits_for(r.particles));
  return {at, 1U << at, lanes};
}

std::vector<Parameter> chain_parameters(const Capacity& c) {
  return {parameter("Lanes", static_cast<int>(c.lanes)), parameter("Most", static_cast<int>(c.most)),
          parameter("Overlapped", static_cast<int>(c.overlapped))};
}

std::vector<Parameter> chain_of_pairs_parameters(const Capacity& c) {
  std::vector<Parameter> all = chain_parameters(c);
  all.push_back(parameter("Folded", 1));
  return all;
}

std::vector<Parameter> cloud_parameters(const Capacity& c) { return {parameter("Lanes", static_cast<int>(c.lanes))}; }

std::vector<Parameter> no_parameters(const Capacity&) { return {}; }

std::string of_lanes(const Capacity& c, const std::string& what) {
  return c.lanes == 1 ? "" : ", " + what + " multiples of " + std::to_string(c.lanes);
}

std::string chain_range(const Capacity& c) {
  const std::string burn_in = c.lanes == 1 ? "burn_in_i" : std::to_string(c.lanes) + " burn_in_i";
  return "1 <= n_i <= " + std::to_string(c.most) + ", n_i <= draws_i, draws_i + " + burn_in +
         " <= " + std::to_string(1U << c.at) + of_lanes(c, "n_i and draws_i");
}

std::string chain_of_pairs_range(const Capacity& c) {
  return "1 <= n_i <= " + std::to_string(c.most) +
         ", n_i <= draws_i, draws_i + burn_in_i <= " + std::to_string(1U << c.at) + of_lanes(c, "n_i and draws_i") +
         ", burn_in_i goes up to one";
}

std::string cloud_range(const Capacity& c) { return "1 <= n_i <= " + std::to_string(c.most) + of_lanes(c, "n_i"); }

}  // namespace

const std::vector<Architecture>& architectures() {
  static const std::vector<Architecture> all{
      {"imh",
       "independent Metropolis-Hastings, one chain, parents at random",
       "mote_imh",
       "mote/hardware/filters/imh.hpp",
       {kParticles, kDraws, kBurnIn, kChainMean},
       1,
       true,
       5,
       chain_parameters,
       chain_range,
       chain_capacity,
       golden_chains,
       false,
       0,
       false,
       "imh.h"},
      {"imh-parallel",
       "independent Metropolis-Hastings, chains in lockstep, parents from all of them in turn",
       "mote_imh",
       "mote/hardware/filters/imh.hpp",
       {kParticles, kDraws, kBurnIn, kChainMean},
       64,
       true,
       5,
       chain_parameters,
       chain_range,
       chain_capacity,
       golden_chains,
       false,
       0,
       false,
       "imh.h"},
      {"imh-chain",
       "independent Metropolis-Hastings, one chain that pairs of proposer and weigher feed a row a cycle",
       "mote_imh",
       "mote/hardware/filters/imh.hpp",
       {kParticles, kDraws, kBurnIn, kChainMean},
       8,
       true,
       6,
       chain_of_pairs_parameters,
       chain_of_pairs_range,
       chain_of_pairs_capacity,
       golden_chain,
       true,
       1},
      {"auxiliary",
       "auxiliary-variable independent Metropolis-Hastings: one chain over pairs of state and parent, any proposal",
       "mote_imh",
       "mote/hardware/filters/imh.hpp",
       {kParticles, kDraws, kBurnIn, kChainMean},
       1,
       true,
       5,
       chain_parameters,
       chain_range,
       chain_capacity,
       golden_chains,
       false,
       0,
       true},
      {"sisr",
       "bootstrap filter, one lane, systematic resampling of a step beside the next one's proposals",
       "mote_sisr",
       "mote/hardware/filters/sisr.hpp",
       {kParticles},
       1,
       false,
       5,
       cloud_parameters,
       cloud_range,
       cloud_capacity,
       golden_cloud,
       false,
       0,
       false,
       "sisr.h"},
      {"sisr-lanes",
       "bootstrap filter, lanes abreast, systematic resampling of a step beside the next one's proposals",
       "mote_sisr",
       "mote/hardware/filters/sisr.hpp",
       {kParticles},
       8,
       false,
       6,
       cloud_parameters,
       cloud_range,
       cloud_capacity,
       golden_cloud,
       false,
       0,
       false,
       "sisr.h"},
      {"sisr-plain",
       "bootstrap filter in separate loops, nothing overlapped: what the others are measured against",
       "mote_sisr_plain",
       "mote/hardware/filters/sisr.hpp",
       {kParticles},
       1,
       false,
       6,
       no_parameters,
       cloud_range,
       cloud_capacity,
       golden_loops,
       false,
       0,
       false,
       "sisr.h"},
  };
  return all;
}

}  // namespace mote::hardware
