#include "mote/vision/appearance.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::vision {
namespace {

constexpr float kRange = 4;  // normalised pixels beyond +-4 contrasts count as there

double gaussian(double z, double mean, double variance) {
  return std::exp(-0.5 * (z - mean) * (z - mean) / variance) / std::sqrt(2 * kPi * variance);
}

}  // namespace

Appearance::Appearance(std::span<const float> first, const AppearanceOptions& options)
    : options_(options), pixels_(kPixels), table_(kPixels * kLevels), means_(kPixels) {
  const double variance = options.first_sd * options.first_sd;
  constexpr std::array<double, kCauses> kStart{0.6, 0.3, 0.1};
  for (std::size_t j = 0; j < kPixels; ++j) {
    const double z = first[j];
    pixels_[j] = {kStart, kStart[kStable] * z, kStart[kStable] * (z * z + variance), z};
  }
  tabulate();
}

double Appearance::stable_variance(std::size_t j) const {
  const double mean = stable_mean(j);
  const double variance = pixels_[j].moment2 / pixels_[j].mixing[kStable] - mean * mean;
  return std::max(variance, options_.least_sd * options_.least_sd);
}

std::array<double, kCauses> Appearance::joint(std::size_t j, double z) const {
  const Pixel& p = pixels_[j];
  return {p.mixing[kStable] * gaussian(z, stable_mean(j), stable_variance(j)),
          p.mixing[kWandering] * gaussian(z, p.wandering_mean, options_.first_sd * options_.first_sd),
          p.mixing[kLost] * gaussian(z, 0, options_.lost_sd * options_.lost_sd)};
}

double Appearance::lost_share(std::span<const float> patch) const {
  std::size_t lost = 0;
  for (std::size_t j = 0; j < kPixels; ++j) {
    const auto by = joint(j, patch[j]);
    lost += by[kLost] > by[kStable] + by[kWandering];
  }
  return static_cast<double>(lost) / kPixels;
}

double Appearance::learn(std::span<const float> patch, double rate) {
  const double share = lost_share(patch);
  if (share > options_.outlier_share) return share;
  const double a = rate * (1 - std::exp(-std::log(2.0) / options_.half_life));
  constexpr double kLeastMixing = 0.02;  // no cause is ever ruled out
  for (std::size_t j = 0; j < kPixels; ++j) {
    Pixel& p = pixels_[j];
    const double z = patch[j];
    const auto by = joint(j, z);
    if (by[kLost] > by[kStable] + by[kWandering]) continue;
    const double all = by[kStable] + by[kWandering] + by[kLost];
    const double mean = stable_mean(j);
    const double second = p.moment2 / p.mixing[kStable];
    const double carried = (1 - a) * p.mixing[kStable];
    double sum = 0;
    for (std::size_t i = 0; i < kCauses; ++i) {
      p.mixing[i] = std::max(a * by[i] / all + (1 - a) * p.mixing[i], kLeastMixing);
      sum += p.mixing[i];
    }
    for (double& m : p.mixing) m /= sum;
    const double owned = by[kStable] / all;
    const double total = a * owned + carried;
    p.moment1 = p.mixing[kStable] * (a * owned * z + carried * mean) / total;
    p.moment2 = p.mixing[kStable] * (a * owned * z * z + carried * second) / total;
    p.wandering_mean = z;
  }
  tabulate();
  return share;
}

namespace {

/// Adds share N(z_k; mean, variance) at the levels z_k to `sum`, by ratios of neighbours outwards from the mean.
template <std::size_t N>
void add_bell(std::array<float, N>& sum, double share, double mean, double variance) {
  const double step = 2.0 * static_cast<double>(kRange) / N;
  const double first = 0.5 * step - static_cast<double>(kRange);
  const double nearest = std::clamp(std::round((mean - first) / step), 0.0, static_cast<double>(N - 1));
  const auto middle = static_cast<std::size_t>(nearest);
  const double off = first + nearest * step - mean;
  const double peak = share * gaussian(off, 0, variance);
  const double bend = std::exp(-step * step / variance);
  double value = peak;
  double ratio = std::exp(-(off * step + 0.5 * step * step) / variance);
  for (std::size_t k = middle; k < N; ++k, value *= ratio, ratio *= bend) sum[k] += static_cast<float>(value);
  ratio = std::exp((off * step - 0.5 * step * step) / variance);
  value = peak * ratio;
  ratio *= bend;
  for (std::size_t k = middle; k-- > 0; value *= ratio, ratio *= bend) sum[k] += static_cast<float>(value);
}

}  // namespace

void Appearance::tabulate() {
  std::array<float, kLevels> densities{};
  std::array<float, kLevels> lost{};
  add_bell(lost, 1, 0, options_.lost_sd * options_.lost_sd);
  for (std::size_t j = 0; j < kPixels; ++j) {
    const Pixel& p = pixels_[j];
    means_[j] = static_cast<float>(stable_mean(j));
    for (std::size_t k = 0; k < kLevels; ++k) densities[k] = static_cast<float>(p.mixing[kLost]) * lost[k];
    add_bell(densities, p.mixing[kStable], stable_mean(j), stable_variance(j));
    add_bell(densities, p.mixing[kWandering], p.wandering_mean, options_.first_sd * options_.first_sd);
    for (std::size_t k = 0; k < kLevels; ++k) table_[j * kLevels + k] = std::log(densities[k]);
  }
}

double Appearance::mean_log_density(std::span<const float> patch) const {
  constexpr std::size_t kLanes = 16;
  constexpr float kPerUnit = kLevels / (2 * kRange);
  float sums[kLanes] = {};
  const float* table = table_.data();
  for (std::size_t j = 0; j < kPixels; j += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float level = (patch[j + lane] + kRange) * kPerUnit;
      const int k = static_cast<int>(std::min(std::max(level, 0.0F), static_cast<float>(kLevels - 1)));
      sums[lane] += table[static_cast<int>((j + lane) * kLevels) + k];
    }
  float sum = 0;
  for (const float part : sums) sum += part;
  return static_cast<double>(sum) / kPixels;
}

double Appearance::exact_mean_log_density(std::span<const float> patch) const {
  double sum = 0;
  for (std::size_t j = 0; j < kPixels; ++j) {
    const auto by = joint(j, patch[j]);
    sum += std::log(by[kStable] + by[kWandering] + by[kLost]);
  }
  return sum / kPixels;
}

double Appearance::mean_squared_distance(std::span<const float> patch) const {
  constexpr std::size_t kLanes = 16;
  float sums[kLanes] = {};
  for (std::size_t j = 0; j < kPixels; j += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float error = patch[j + lane] - means_[j + lane];
      sums[lane] += error * error;
    }
  float sum = 0;
  for (const float part : sums) sum += part;
  return static_cast<double>(sum) / kPixels;
}

}  // namespace mote::vision
