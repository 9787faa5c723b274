#include <gtest/gtest.h>

#include "mote/referee/kalman.hpp"
#include "tests/statistics/linear_models.hpp"
#include "tests/statistics/makers.hpp"

namespace mote::statistics {
namespace {

/// The worst |z| over steps and components of the mean over `runs` runs of the estimated posterior mean, against the
/// exact one; deviations count beyond what the maker is allowed only.
template <class M>
double worst_mean_z(const Maker& maker, const M& model, const Recording& recording, std::size_t particles,
                    std::size_t runs) {
  const auto laws = referee::kalman(model, recording);
  const std::size_t dimensions = model.states().size();
  std::vector<Sample> samples(laws.size() * dimensions);
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const auto filter = maker.make(particles, seed);
    const Trace got = trace(*filter, model.states(), recording);
    for (std::size_t k = 0; k < laws.size(); ++k)
      for (std::size_t d = 0; d < dimensions; ++d) samples[k * dimensions + d].values.push_back(got.means[k][d]);
  }
  double worst = 0;
  for (std::size_t k = 0; k < laws.size(); ++k)
    for (std::size_t d = 0; d < dimensions; ++d) {
      const Sample& sample = samples[k * dimensions + d];
      const auto i = static_cast<Eigen::Index>(d);
      const double slack = maker.bias * std::sqrt(laws[k].covariance(i, i));
      worst = std::max(worst, std::max(0.0, std::abs(sample.mean() - laws[k].mean(i)) - slack) / sample.error());
    }
  return worst;
}

constexpr double kWorstOfAll = 6.5;  // t with 99 degrees: 1e-6 over the at most 700 means of a test is |t| < 6.4

// claim    posterior means agree with the exact ones, for every filter in double and float
// referee  the Kalman filter
// design   100 runs of 1000 particles, seeds 1..100: a bias of order 1/N is a third of a standard error; filters with
//          larger constants are allowed 0.02 to 0.2 posterior standard deviations (makers.hpp)
// risk     1e-6 over all filters and steps (|t| < 6.5); the twin (sigma_y 20 % too large) must be caught for every
//          filter
TEST(Means, OfTheLocalLevelAreKalmans) {
  const auto recording = local_level_recording();
  const auto worst = [&](const Maker& maker) { return worst_mean_z(maker, local_level(), recording, 1000, 100); };
  for (const Maker& maker : unbiased_filters<LocalLevelOptimal>(local_level(), true))
    EXPECT_LT(worst(maker), kWorstOfAll) << maker.name;
  for (const Maker& maker : consistent_filters<LocalLevelOptimal>(local_level()))
    EXPECT_LT(worst(maker), kWorstOfAll) << maker.name;
  for (const Maker& maker : unbiased_filters<LocalLevelOptimal>(local_level(1.2), false))
    EXPECT_GT(worst(maker), kWorstOfAll) << "the twin, " << maker.name;
  for (const Maker& maker : consistent_filters<LocalLevelOptimal>(local_level(1.2)))
    EXPECT_GT(worst(maker), kWorstOfAll) << "the twin, " << maker.name;
}

// claim, referee, risk and twin as above; a plane with missing entries
TEST(Means, OfAPlaneWithMissingEntriesAreKalmans) {
  const auto recording = plane_recording();
  const auto worst = [&](const Maker& maker) { return worst_mean_z(maker, plane(), recording, 1000, 100); };
  for (const Maker& maker : unbiased_filters<LinearGaussianOptimal>(plane(), false))
    EXPECT_LT(worst(maker), kWorstOfAll) << maker.name;
  for (const Maker& maker : consistent_filters<LinearGaussianOptimal>(plane()))
    EXPECT_LT(worst(maker), kWorstOfAll) << maker.name;
  EXPECT_GT(worst(unbiased_filters<LinearGaussianOptimal>(plane(1.2), false).front()), kWorstOfAll) << "the twin";
}

// claim    parents swept in chain order leave a bias that does not fall with N; permuted parents do not
// referee  the Kalman filter
// design   30 steps, 200 runs of 1000 particles and 40 of 10 000, the bias of the last mean (posterior standard
//          deviation 0.8)
// risk     1e-6 (|t| < 5.8 with 39 degrees); swept parents are the twin of permuted ones
TEST(Means, SweptParentsDoNotConverge) {
  const auto recording = simulate(local_level(), 30, 1001).recording;
  const double exact = referee::kalman(local_level(), recording).back().mean(0);
  const auto bias = [&](const std::string& name, Parents parents, std::size_t particles, std::size_t runs) {
    Sample last;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
      const auto filter =
          make_imh(local_level(), particles, seed, {.parents = parents, .start = ChainStart::kWeighted});
      last.values.push_back(trace(*filter, local_level().states(), recording).means.back()[0] - exact);
    }
    measured("local level, imh, parents " + name + ", N = " + std::to_string(particles) + ": bias of the mean",
             last.mean(), last.error());
    return last;
  };
  EXPECT_LT(std::abs(bias("permuted", Parents::kPermuted, 1000, 200).z(0)), 5.8);
  EXPECT_LT(std::abs(bias("permuted", Parents::kPermuted, 10000, 40).z(0)), 5.8);
  EXPECT_LT(bias("swept", Parents::kSweep, 1000, 200).z(0), -5.8);
  EXPECT_LT(bias("swept", Parents::kSweep, 10000, 40).z(0), -5.8);
}

// claim    groups that lose weight are still close: PPF's restarted group weights and replace
// referee  the Kalman filter; posterior standard deviations are about 0.8
// design   100 runs of 1000 particles in 8 groups, mean of the last step
// risk     1e-6 for an unbiased filter (0.05 is fourteen standard errors); measured biases are below 0.005
TEST(Means, OfGroupsThatForgetWeightAreNear) {
  const auto recording = local_level_recording();
  const double exact = referee::kalman(local_level(), recording).back().mean(0);
  for (const auto& [name, groups] :
       {std::pair{"replace", groups_of(8, Exchange::kReplace)},
        std::pair{"restarted group weights", groups_of(8, Exchange::kNone, false)},
        std::pair{"restarted group weights, swap", groups_of(8, Exchange::kSwap, false)}}) {
    Sample means;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const auto filter = make_distributed(local_level(), 1000, seed, groups);
      means.values.push_back(trace(*filter, local_level().states(), recording).means.back()[0]);
    }
    measured(std::string("local level, 8 groups, ") + name + ", N = 1000: bias of the mean", means.mean() - exact,
             means.error());
    EXPECT_NEAR(means.mean(), exact, 0.05) << name;
  }
}

/// Slope of log mean square error against log N, by least squares over N = 100, 200, ... 6400.
double log_log_slope(const Maker& maker, std::size_t runs) {
  const auto recording = local_level_recording();
  std::vector<double> exact;
  for (const auto& law : referee::kalman(local_level(), recording)) exact.push_back(law.mean(0));
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double sxy = 0;
  constexpr int kSizes = 7;
  for (int i = 0; i < kSizes; ++i) {
    const std::size_t n = std::size_t{100} << static_cast<unsigned>(i);
    double error = 0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed)
      error += mean_square_error(trace(*maker.make(n, seed), local_level().states(), recording), exact);
    const double x = std::log(static_cast<double>(n));
    const double y = std::log(error / static_cast<double>(runs));
    sx += x / kSizes;
    sy += y / kSizes;
    sxx += x * x / kSizes;
    sxy += x * y / kSizes;
  }
  return (sxy - sx * sy) / (sxx - sx * sx);
}

// claim    the mean square error of the mean falls like 1/N
// referee  the Kalman filter
// design   200 runs at each of N = 100, 200, ... 6400; the slope has a standard error of about 0.015
// risk     1e-6 (0.1 is six standard errors); the twin (a filter whose noise is 5 % too large: a floor under the
//          error) must be caught
TEST(Means, ErrorFallsLikeOneOverN) {
  const auto sisr = [](double noise_scale) {
    return Maker{"sisr",
                 [=](std::size_t n, std::uint64_t seed) { return make_sisr(local_level(noise_scale), n, seed); }};
  };
  const double slope = log_log_slope(sisr(1), 200);
  measured("local level, sisr: slope of log MSE against log N", slope, 0.015);
  EXPECT_NEAR(slope, -1, 0.1);
  EXPECT_GT(log_log_slope(sisr(1.05), 50), -0.9) << "the twin";
}

}  // namespace
}  // namespace mote::statistics
