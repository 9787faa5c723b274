#include <gtest/gtest.h>

#include "mote/engine/run.hpp"
#include "mote/hardware/filters/cosim/models.hpp"
#include "mote/hardware/filters/imh.hpp"
#include "mote/model/local_level.hpp"
#include "mote/referee/kalman.hpp"
#include "mote/software/reference.hpp"
#include "tests/statistics/support.hpp"

namespace mote::statistics {
namespace {

constexpr std::uint32_t kParticles = 200;
constexpr Step kLength = 50;

/// Sum of squared differences of a step's means from the exact ones.
using Errors = std::function<double(const Recording&, const std::vector<referee::Gaussian>&, std::uint64_t)>;

/// Root mean square difference from the exact means over recordings of the local level.
double rmse(std::uint64_t recordings, const Errors& errors) {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= recordings; ++seed) {
    const Recording recording = simulate(LocalLevel{}, kLength, seed).recording;
    squares += errors(recording, referee::kalman(LocalLevel{}, recording), seed);
  }
  return std::sqrt(squares / static_cast<double>(recordings) / static_cast<double>(kLength));
}

double software(const Recording& recording, const std::vector<referee::Gaussian>& laws, std::uint64_t seed) {
  Plan plan;
  plan.filter = FilterKind::kImh;
  plan.particles = kParticles;
  plan.seed = seed;
  RunRequest request;
  request.states = LocalLevel{}.states();
  const auto filter = make_reference_filter(LocalLevel{}, plan, "test");
  const RunRecord record = run(*filter, plan, recording, request);
  double squares = 0;
  for (std::size_t k = 0; k < laws.size(); ++k) squares += std::pow(record.rows[k].states[0].mean - laws[k].mean(0), 2);
  return squares;
}

/// The golden model of the IMH circuit; `shrink` makes its log weights wrong, for the twin.
double circuit(const hardware::ImhRegisters& registers, unsigned shrink, const Recording& recording,
               const std::vector<referee::Gaussian>& laws, std::uint64_t seed) {
  hardware::Arithmetic model = hardware::cosim::local_level();
  model.weigh = [weigh = model.weigh, shrink](unsigned t, hardware::Observed observed,
                                              const hardware::Particles& states, std::span<std::int64_t> log_weights) {
    weigh(t, observed, states, log_weights);
    for (std::int64_t& log_weight : log_weights) log_weight >>= shrink;
  };
  hardware::Imh filter(model, seed);
  filter.start(registers);
  double squares = 0;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const std::vector<std::int64_t> y{std::lround(32 * recording.steps[k].rows[0][0])};
    const auto mean = static_cast<double>(filter.step(y).mean[0]) / (32 * 256);
    squares += std::pow(mean - laws[k].mean(0), 2);
  }
  return squares;
}

// claim    the IMH circuit is no farther from the exact means than the software filter, within 3 %. Measured 3.5 %
//          nearer
// referee  the Kalman filter; the reference engine's IMH filter with as many particles
// design   1500 recordings of 50 steps of the local level, N = 200; seeds 1 .. 1500, fixed
// risk     none: fixed seeds; the standard error of the ratio is about 0.8 %. The twin (log weights halved) must be
//          caught, and the chain's mean is worse, as theory says
TEST(ImhCircuit, IsAsAccurateAsTheSoftwareFilter) {
  const hardware::ImhRegisters registers{kParticles, kParticles, 0, false};
  using std::placeholders::_1, std::placeholders::_2, std::placeholders::_3;
  const double expected = rmse(1500, software);
  const double got = rmse(1500, std::bind(circuit, registers, 0, _1, _2, _3));
  std::printf("RMSE to the exact means: circuit %.3f, software %.3f, ratio %.4f\n", got, expected, got / expected);
  EXPECT_LT(got / expected, 1.03);
  EXPECT_GT(rmse(100, std::bind(circuit, registers, 1, _1, _2, _3)) / expected, 1.1) << "the twin";
  auto by_chain = registers;
  by_chain.chain_mean = true;
  EXPECT_GT(rmse(1500, std::bind(circuit, by_chain, 0, _1, _2, _3)) / expected, 1.03);
}

}  // namespace
}  // namespace mote::statistics
