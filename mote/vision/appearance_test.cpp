#include "mote/vision/appearance.hpp"

#include <cmath>

#include <opencv2/core.hpp>

#include "mote/base/numbers.hpp"

namespace mote::vision {
namespace {

std::vector<float> random_patch(int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  std::vector<float> z(kPixels);
  for (float& value : z) value = static_cast<float>(random.gaussian(1));
  return z;
}

std::vector<float> noisy(const std::vector<float>& z, double sd, int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  std::vector<float> out = z;
  for (float& value : out) value += static_cast<float>(random.gaussian(sd));
  return out;
}

double density(double z, double mean, double variance) {
  return std::exp(-(z - mean) * (z - mean) / (2 * variance)) / std::sqrt(2 * kPi * variance);
}

/// One pixel by the published equations, written from them.
struct Referee {
  double m[3] = {0.6, 0.3, 0.1};
  double first, second, last;
  AppearanceOptions options;

  Referee(double z, const AppearanceOptions& o)
      : first(0.6 * z), second(0.6 * (z * z + o.first_sd * o.first_sd)), last(z), options(o) {}

  void see(double z) {
    const double mean = first / m[0];
    const double variance = std::max(second / m[0] - mean * mean, options.least_sd * options.least_sd);
    const double p[3] = {m[0] * density(z, mean, variance),
                         m[1] * density(z, last, options.first_sd * options.first_sd),
                         m[2] * density(z, 0, options.lost_sd * options.lost_sd)};
    if (p[2] > p[0] + p[1]) return;
    const double a = 1 - std::exp2(-1 / options.half_life);
    const double sum = p[0] + p[1] + p[2];
    for (int i = 0; i < 3; ++i) m[i] = a * p[i] / sum + (1 - a) * m[i];
    first = a * z * p[0] / sum + (1 - a) * first;
    second = a * z * z * p[0] / sum + (1 - a) * second;
    last = z;
  }
};

TEST(Appearance, LearnsAsTheEquationsSay) {
  const AppearanceOptions options;
  const std::vector<float> first = random_patch(1);
  Appearance appearance(first, options);
  std::vector<Referee> referees;
  for (const float z : first) referees.emplace_back(z, options);
  for (int t = 2; t < 12; ++t) {
    const std::vector<float> z = noisy(first, 0.15, t);
    appearance.learn(z);
    for (std::size_t j = 0; j < kPixels; ++j) referees[j].see(z[j]);
  }
  std::size_t compared = 0;
  for (std::size_t j = 0; j < kPixels; ++j) {
    if (std::abs(first[j]) > 2) continue;  // there the least mixing weight may hold
    EXPECT_NEAR(appearance.stable_mean(j), referees[j].first / referees[j].m[0], 1e-9);
    EXPECT_NEAR(appearance.pixel(j).mixing[kStable], referees[j].m[0], 1e-9);
    EXPECT_NEAR(appearance.pixel(j).wandering_mean, referees[j].last, 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, kPixels * 9 / 10);
}

TEST(Appearance, TheTableIsTheEquation) {
  const std::vector<float> first = random_patch(1);
  Appearance appearance(first, {});
  for (int t = 2; t < 6; ++t) appearance.learn(noisy(first, 0.2, t));
  for (const double sd : {0.1, 0.3, 0.6}) {
    const std::vector<float> z = noisy(first, sd, 9);
    EXPECT_NEAR(appearance.mean_log_density(z), appearance.exact_mean_log_density(z), 0.04) << sd;
  }
}

TEST(Appearance, MoreNoiseFitsWorse) {
  const std::vector<float> first = random_patch(1);
  const Appearance appearance(first, {});
  double last = kInfinity;
  for (const double sd : {0.0, 0.2, 0.5, 1.0}) {
    const double fit = appearance.mean_log_density(noisy(first, sd, 4));
    EXPECT_LT(fit, last);
    last = fit;
  }
  EXPECT_LT(appearance.mean_squared_distance(first), appearance.mean_squared_distance(noisy(first, 0.5, 4)));
}

TEST(Appearance, WhatHidesTheTargetIsNotLearnt) {
  const std::vector<float> first = random_patch(1);
  Appearance appearance(first, {});
  for (int t = 2; t < 30; ++t) appearance.learn(noisy(first, 0.1, t));
  std::vector<float> hidden = first;
  for (std::size_t j = 0; j < kPixels / 4; ++j) hidden[j] = first[j] > 0 ? -3.0F : 3.0F;
  const double before = appearance.stable_mean(5);
  for (int t = 0; t < 20; ++t) EXPECT_NEAR(appearance.learn(hidden), 0.25, 0.02);
  EXPECT_NEAR(appearance.stable_mean(5), before, 1e-9);
}

TEST(Appearance, APatchThatIsMostlyLostTeachesNothing) {
  const std::vector<float> first = random_patch(1);
  Appearance appearance(first, {});
  for (int t = 2; t < 30; ++t) appearance.learn(noisy(first, 0.1, t));
  const double before = appearance.exact_mean_log_density(first);
  std::vector<float> other = first;
  for (float& z : other) z = z > 0 ? -3.0F : 3.0F;
  EXPECT_GT(appearance.learn(other), 0.9);
  EXPECT_EQ(appearance.exact_mean_log_density(first), before);
}

}  // namespace
}  // namespace mote::vision
