#include "mote/hardware/machine/architecture.hpp"

#include <algorithm>
#include <bit>

#include "mote/hardware/filters/groups.hpp"

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
    else if constexpr (requires { filter_.start(registers.particles, registers.exchange); })
      filter_.start(registers.particles, registers.exchange);
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
  return std::make_unique<GoldenOf<Imh>>(
      arithmetic, seed, 0, ImhLanes{capacity.lanes, Parents::kBanked, false, capacity.variant.overlapped});
}

std::unique_ptr<Golden> golden_chain(const Arithmetic& arithmetic, std::uint64_t seed, const Capacity& capacity) {
  return std::make_unique<GoldenOf<Imh>>(arithmetic, seed, 0,
                                         ImhLanes{capacity.lanes, Parents::kBanked, true, capacity.variant.overlapped});
}

/// The arithmetic of a filter that counts up to 2^bits particles, in each of its memories of weights.
Arithmetic counting(Arithmetic arithmetic, unsigned bits) {
  arithmetic.formats.count_bits = bits;
  return arithmetic;
}

std::unique_ptr<Golden> golden_cloud(const Arithmetic& arithmetic, std::uint64_t seed, const Capacity& capacity) {
  return std::make_unique<GoldenOf<Sisr>>(counting(arithmetic, capacity.at), seed, 0, capacity.lanes,
                                          capacity.variant.resampler);
}

std::unique_ptr<Golden> golden_loops(const Arithmetic& arithmetic, std::uint64_t seed, const Capacity& capacity) {
  return std::make_unique<GoldenOf<Sisr>>(counting(arithmetic, capacity.at), seed, 0, capacity.variant.loops,
                                          capacity.variant.resampler);
}

std::unique_ptr<Golden> golden_groups(const Arithmetic& arithmetic, std::uint64_t seed, const Capacity& capacity) {
  return std::make_unique<GoldenOf<Groups>>(counting(arithmetic, capacity.slot_bits()), seed, 0, capacity.lanes,
                                            capacity.variant.resampler);
}

const Register kParticles{"n", "N, particles, from 1", false, [](const RunRegisters& r) { return r.particles; }};
const Register kDraws{"draws", "Q, proposals beside the burn-in, at least N", false,
                      [](const RunRegisters& r) { return r.draws; }};
const Register kBurnIn{"burn_in", "N_b, proposals that the chain forgets", false,
                       [](const RunRegisters& r) { return r.burn_in; }};
const Register kChainMean{"chain_mean", "1: the mean over the kept states, 0: over all weighted proposals", true,
                          [](const RunRegisters& r) { return std::uint32_t{r.chain_mean}; }};

const Register kExchange{"exchange", "M, children that each group has from the one before it, at most N / lanes", false,
                         [](const RunRegisters& r) { return r.exchange; }};

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

constexpr unsigned kLeastBits = 6;  ///< of the counts of what resamples

Capacity cloud_capacity(const RunRegisters& r, unsigned lanes) {
  const unsigned at = std::max(kLeastBits, bits_for(r.particles));
  return {at, 1U << at, lanes};
}

Capacity group_capacity(const RunRegisters& r, unsigned lanes) {
  const unsigned at = std::max(kLeastBits + bits_for(lanes), bits_for(r.particles));
  return {at, 1U << at, lanes};
}

std::vector<Parameter> chain_parameters(const Capacity& c) {
  return {parameter("Lanes", static_cast<int>(c.lanes)), parameter("Most", static_cast<int>(c.most)),
          parameter("Overlapped", static_cast<int>(c.variant.overlapped))};
}

std::vector<Parameter> chain_of_pairs_parameters(const Capacity& c) {
  std::vector<Parameter> all = chain_parameters(c);
  all.push_back(parameter("Folded", 1));
  return all;
}

Parameter scheme_of(const Capacity& c) { return parameter("Scheme", static_cast<int>(c.variant.resampler)); }

std::vector<Parameter> cloud_parameters(const Capacity& c) {
  return {parameter("Lanes", static_cast<int>(c.lanes)), scheme_of(c)};
}

std::vector<Parameter> loop_parameters(const Capacity& c) {
  return {parameter("Pipelined", static_cast<int>(c.variant.loops.pipelined)),
          parameter("Merged", static_cast<int>(c.variant.loops.merged)), scheme_of(c)};
}

std::string of_lanes(const Capacity& c, const std::string& what) {
  return c.lanes == 1 ? "" : ", " + what + " multiples of " + std::to_string(c.lanes);
}

std::string chain_range(const Capacity& c) {
  const std::string burn_in = c.lanes == 1 ? "burn_in_i" : std::to_string(c.lanes) + " burn_in_i";
  return "1 <= n_i <= " + std::to_string(c.most) + ", n_i <= draws_i, draws_i + " + burn_in +
         " <= " + std::to_string(1U << c.at) + of_lanes(c, "n_i and draws_i");
}

std::string group_range(const Capacity& c) {
  return "1 <= n_i <= " + std::to_string(c.most) + of_lanes(c, "n_i") + ", " + std::to_string(c.lanes) +
         " exchange_i <= n_i";
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
       false,
       false,
       false,
       "imh.h",
       true},
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
       false,
       false,
       false,
       "imh.h",
       true},
      {"imh-chain",
       "independent Metropolis-Hastings, one chain that pairs of proposer and weigher feed a row a cycle",
       "mote_imh",
       "mote/hardware/filters/imh.hpp",
       {kParticles, kDraws, kBurnIn, kChainMean},
       8,
       true,
       5,
       chain_of_pairs_parameters,
       chain_of_pairs_range,
       chain_of_pairs_capacity,
       golden_chain,
       true,
       false,
       false,
       false,
       "imh.h"},
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
       true,
       false,
       false,
       "imh.h",
       true},
      {"sisr",
       "bootstrap filter, one lane, resampling of a step beside the next one's proposals",
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
       false,
       true,
       false,
       "sisr.h",
       true},
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
       false,
       false,
       false,
       "sisr.h",
       true},
      {"sisr-plain",
       "bootstrap filter in separate loops, nothing overlapped: what the others are measured against",
       "mote_sisr_plain",
       "mote/hardware/filters/sisr.hpp",
       {kParticles},
       1,
       false,
       6,
       loop_parameters,
       cloud_range,
       cloud_capacity,
       golden_loops,
       false,
       false,
       true,
       true,
       "sisr.h"},
      {"groups",
       "parallel particle filter: a group a lane, each resamples by itself, a ring exchanges children",
       "mote_groups",
       "mote/hardware/filters/groups.hpp",
       {kParticles, kExchange},
       8,
       false,
       5,
       cloud_parameters,
       group_range,
       group_capacity,
       golden_groups,
       false,
       false,
       true,
       false,
       "groups.h"},
  };
  return all;
}

}  // namespace mote::hardware
