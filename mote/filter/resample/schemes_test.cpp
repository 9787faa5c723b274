#include "mote/filter/resample/schemes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "mote/base/scan.hpp"

namespace mote {
namespace {

using Weights = std::vector<double>;

/// A weight vector that has broken a resampler, with the number of children to draw from it.
struct Case {
  std::string name;
  Weights weights;
  std::size_t children;
  int repeats;
};

template <class F>
Weights weights_of(std::size_t n, F&& f) {
  Weights w(n);
  for (std::size_t i = 0; i < n; ++i) w[i] = f(i);
  return w;
}

Weights log_normal(std::size_t n, double sd) {
  Weights w(n);
  Draws{77, 1}.for_each(Purpose::kTest, 0, n, [&](std::size_t i, auto& draw) { w[i] = std::exp(sd * draw.normal()); });
  return w;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"one-hot", weights_of(50, [](std::size_t i) { return i == 17 ? 3.0 : 0.0; }), 50, 200},
      {"many zeros", weights_of(300, [](std::size_t i) { return i % 7 == 3 ? 1.0 + static_cast<double>(i) : 0.0; }),
       300, 2000},
      {"zeros at both ends", weights_of(40, [](std::size_t i) { return i < 9 || i > 30 ? 0.0 : 0.7; }), 40, 2000},
      {"all equal, not binary", weights_of(49, [](std::size_t) { return 1.0 / 49; }), 49, 2000},
      {"ties", weights_of(64, [](std::size_t i) { return static_cast<double>(i / 16 + 1); }), 50, 2000},
      {"tiny scale", weights_of(100, [](std::size_t i) { return 1e-300 * static_cast<double>(1 + i % 5); }), 100, 2000},
      {"very skewed", log_normal(200, 5), 200, 400},
      {"fewer children", log_normal(200, 1), 10, 4000},
      {"more children", log_normal(7, 1), 1000, 1000},
      {"a single particle", {0.4}, 5, 100},
      {"one child", {1, 0, 2, 5}, 1, 4000},
      {"a million",
       weights_of(1000000, [](std::size_t i) { return 0.25 + static_cast<double>(mixed(i) >> 11U) * 0x1p-53; }),
       1000000, 2},
  };
  return all;
}

double sum(std::span<const double> w) { return static_cast<double>(std::accumulate(w.begin(), w.end(), 0.0L)); }

/// The distance from its mean that a sum of independent terms, each within 1 of its mean, exceeds with probability
/// `risk` at most. source  Bernstein's inequality: P(|S - ES| >= t) <= 2 exp(-t^2 / (2 (V + t / 3)))
double bernstein(double variance, double risk) {
  const double l = std::log(2 / risk);
  return l / 3 + std::sqrt(l * l / 9 + 2 * variance * l);
}

/// Mean and variance of the children of the particles [first, last) in one call.
struct Expected {
  double mean, variance;
};
double fraction(double v) { return v - std::floor(v); }

/// Independent children (multinomial, roulette, alias; rejection and metropolis vary less).
Expected independent(const Weights& w, std::size_t children, std::size_t first, std::size_t last) {
  const double p = sum(std::span(w).subspan(first, last - first)) / sum(w);
  return {static_cast<double>(children) * p, static_cast<double>(children) * p * std::max(0.0, 1 - p)};
}
/// The particles cover the interval [a, b] of the children's axis.
struct Interval {
  double a, b;
};
Interval interval(const Weights& w, std::size_t children, std::size_t first, std::size_t last) {
  const double scale = static_cast<double>(children) / sum(w);
  return {scale * sum(std::span(w).first(first)), scale * sum(std::span(w).first(last))};
}
/// One uniform: the count is floor or ceiling of the length.
Expected of_systematic(const Weights& w, std::size_t children, std::size_t first, std::size_t last) {
  const auto [a, b] = interval(w, children, first, last);
  return {b - a, fraction(b - a) * (1 - fraction(b - a))};
}
/// Only the strata that hold an end of the interval are random.
Expected of_stratified(const Weights& w, std::size_t children, std::size_t first, std::size_t last) {
  const auto [a, b] = interval(w, children, first, last);
  if (std::floor(a) == std::floor(b)) return {b - a, (b - a) * (1 - (b - a))};
  return {b - a, fraction(a) * (1 - fraction(a)) + fraction(b) * (1 - fraction(b))};
}
/// The remainders are multinomial.
Expected of_residual(const Weights& w, std::size_t children, std::size_t first, std::size_t last) {
  const double scale = static_cast<double>(children) / sum(w);
  double mean = 0;
  double rest = 0;
  double all = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double r = fraction(w[i] * scale * (1 + 1e-12));
    all += r;
    if (i < first || i >= last) continue;
    mean += w[i] * scale;
    rest += r;
  }
  return {mean, rest * std::max(0.0, 1 - rest / std::max(all, 1e-9))};
}

using Law = Expected (*)(const Weights&, std::size_t, std::size_t, std::size_t);
Law law_of(std::string_view scheme) {
  if (scheme == "systematic") return of_systematic;
  if (scheme == "stratified") return of_stratified;
  if (scheme == "residual") return of_residual;
  return independent;
}

/// The children of each particle over all repeats.
std::vector<double> counted(ResampleFunction resample, const Case& c) {
  std::vector<double> counts(c.weights.size());
  std::vector<std::uint32_t> ancestors(c.children);
  for (int r = 1; r <= c.repeats; ++r) {
    resample(c.weights, Draws{static_cast<std::uint64_t>(r), 3}, ancestors);
    for (const auto a : ancestors) ++counts.at(a);
  }
  return counts;
}

constexpr double kRiskPerCell = 1e-10;  // over at most 10^4 cells: all schemes, all cases

/// The first runs of neighbours (each with about 50 expected children, at most 200 runs) whose count is not within
/// Bernstein's bound, as text.
std::string wrong_means(ResampleFunction resample, Law law, const Case& c, double bias) {
  const std::vector<double> counts = counted(resample, c);
  const double total = sum(c.weights);
  const auto repeats = static_cast<double>(c.repeats);
  const double cell = std::max(50.0, repeats * static_cast<double>(c.children) / 200);
  std::string wrong;
  for (std::size_t first = 0, last = 0; first < counts.size(); first = last) {
    double weight = 0;
    double got = 0;
    while (last < counts.size() && repeats * static_cast<double>(c.children) * weight / total < cell) {
      weight += c.weights[last];
      got += counts[last++];
    }
    const Expected e = law(c.weights, c.children, first, last);
    const double allowed = bernstein(repeats * e.variance, kRiskPerCell) * (e.variance > 1e-9 ? 1 : 0);
    const double slack = bias * repeats * static_cast<double>(c.children) + 1e-6 * repeats;
    if (std::abs(got - repeats * e.mean) > allowed + slack)
      wrong += c.name + ": particles " + std::to_string(first) + ".." + std::to_string(last - 1) + " got " +
               std::to_string(got) + " children, expected " + std::to_string(repeats * e.mean) + " +- " +
               std::to_string(allowed + slack) + "\n";
  }
  return wrong.substr(0, 600);
}

double bias_of(std::string_view scheme) { return scheme == "metropolis" ? 1e-4 : 0; }  // total variation that it states

// claim    every scheme gives particle i a mean of N_out w_i / sum w children, to the bias that metropolis states
// referee  Bernstein's inequality with the variance of the scheme's own law
// design   12 weight vectors, up to 4000 calls each, seeds 1, 2, ...; neighbours pooled to at least 50 expected
// children risk     below 1e-6 over all schemes, cases and cells (10^-10 a cell, proven, not asymptotic); twins below
// must be caught
TEST(Schemes, MeanOffspringIsTheWeight) {
  for (const Scheme& scheme : schemes())
    for (const Case& c : cases())
      EXPECT_EQ(wrong_means(scheme.resample, law_of(scheme.name), c, bias_of(scheme.name)), "") << scheme.name;
}

TEST(Schemes, NeverChooseAWeightOfZero) {
  for (const Scheme& scheme : schemes())
    for (Case c : cases()) {
      c.repeats = std::min(c.repeats, 200);
      const std::vector<double> counts = counted(scheme.resample, c);
      for (std::size_t i = 0; i < counts.size(); ++i)
        ASSERT_TRUE(c.weights[i] > 0 || counts[i] == 0) << scheme.name << ", " << c.name << ", particle " << i;
    }
}

/// Children in one call.
std::vector<double> offspring(ResampleFunction resample, const Case& c, std::uint64_t seed) {
  std::vector<double> counts(c.weights.size());
  std::vector<std::uint32_t> ancestors(c.children);
  resample(c.weights, Draws{seed, 9}, ancestors);
  for (const auto a : ancestors) ++counts.at(a);
  return counts;
}

/// Whether every count of a few calls lies in [N w - below, N w + above].
template <class Low, class High>
bool counts_within(ResampleFunction resample, Low&& low, High&& high) {
  for (const Case& c : cases()) {
    const double scale = static_cast<double>(c.children) / sum(c.weights);
    for (std::uint64_t seed = 1; seed <= (c.weights.size() > 10000 ? 1U : 50U); ++seed) {
      const auto counts = offspring(resample, c, seed);
      for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] < low(c.weights[i] * scale) || counts[i] > high(c.weights[i] * scale)) return false;
    }
  }
  return true;
}

constexpr double kRounding = 1e-6;  // of a child
double floor_of(double expected) { return std::floor(expected - kRounding); }
double ceiling_of(double expected) { return std::ceil(expected + kRounding); }
double at_least(double expected) { return std::floor(expected + kRounding); }
double unbounded(double) { return 1e300; }

/// Twin: a "stratified" scheme that draws one uniform and gives every child to the same parent.
void one_parent(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const WeightScan scan(weights);
  auto block = draws.block(Purpose::kSelect);
  const double u = block.particle(0).uniform();
  for (auto& a : ancestors) a = static_cast<std::uint32_t>(scan.find(u * scan.total()));
}

/// Twin: residual resampling whose remainder is drawn from the full weights, as four libraries have it.
void residual_from_weights(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  const double total = sum(weights);
  std::size_t placed = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (double k = 0;
         k < std::floor(weights[i] / total * static_cast<double>(ancestors.size())) && placed < ancestors.size(); ++k)
      ancestors[placed++] = static_cast<std::uint32_t>(i);
  if (placed < ancestors.size()) multinomial(weights, draws, ancestors.subspan(placed));
}

/// Twin: inversion that is late by one particle.
void late_by_one(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors) {
  roulette(weights, draws, ancestors);
  for (auto& a : ancestors) a = std::min(a + 1, static_cast<std::uint32_t>(weights.size() - 1));
}

const Case& skewed() { return cases()[6]; }

TEST(Schemes, TheTwinsAreCaught) {
  EXPECT_NE(wrong_means(one_parent, of_stratified, skewed(), 0), "");
  EXPECT_NE(wrong_means(residual_from_weights, of_residual, skewed(), 0), "");
  EXPECT_NE(wrong_means(late_by_one, independent, skewed(), 0), "");
  EXPECT_FALSE(counts_within(
      one_parent, [](double e) { return e - 2; }, [](double e) { return e + 2; }));
  EXPECT_FALSE(counts_within(multinomial, floor_of, ceiling_of));
  EXPECT_FALSE(counts_within(multinomial, at_least, unbounded));
}

TEST(Schemes, SystematicGivesFloorOrCeiling) { EXPECT_TRUE(counts_within(systematic, floor_of, ceiling_of)); }

TEST(Schemes, StratifiedIsWithinTwo) {
  EXPECT_TRUE(counts_within(
      stratified, [](double e) { return e - 2; }, [](double e) { return e + 2; }));
}

TEST(Schemes, ResidualGivesAtLeastTheFloor) { EXPECT_TRUE(counts_within(residual, at_least, unbounded)); }

// Equal weights are the commonest case after an unobserved step: the low-variance schemes must copy each particle once.
TEST(Schemes, EqualWeightsAreCopiedOnce) {
  for (std::size_t n = 1; n <= 400; ++n) {
    const Case c{"equal", Weights(n, 1.0 / static_cast<double>(n)), n, 1};
    for (const auto resample : {systematic, residual}) {
      const auto counts = offspring(resample, c, n);
      ASSERT_EQ(std::count(counts.begin(), counts.end(), 1.0), static_cast<std::ptrdiff_t>(n)) << n;
    }
  }
}

// claim    children of the independent schemes have the multinomial covariance N (W_i 1{i=j} - W_i W_j)
// referee  the formula; standard error of a covariance from the sample itself
// design   20 000 calls of 20 children from the weights 1, 2, 3, 4
// risk     1e-6 (|z| < 5.9 over 4 schemes and 10 pairs); the twin (systematic) must be caught
double worst_covariance_z(ResampleFunction resample) {
  const Case c{"four", {1, 2, 3, 4}, 20, 1};
  constexpr int kCalls = 20000;
  std::array<std::array<double, 4>, 4> sums{};
  std::array<std::array<double, 4>, 4> squares{};
  for (std::uint64_t seed = 1; seed <= kCalls; ++seed) {
    const auto counts = offspring(resample, c, seed);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const double product = (counts[i] - 2 * c.weights[i]) * (counts[j] - 2 * c.weights[j]);
        sums[i][j] += product;
        squares[i][j] += product * product;
      }
  }
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double mean = sums[i][j] / kCalls;
      const double error = std::sqrt((squares[i][j] / kCalls - mean * mean) / kCalls) + 1e-12;
      const double p = c.weights[i] / 10;
      const double expected = 20 * ((i == j ? p : 0) - p * c.weights[j] / 10);
      worst = std::max(worst, std::abs(mean - expected) / error);
    }
  return worst;
}

TEST(Schemes, IndependentSchemesHaveTheMultinomialCovariance) {
  for (const auto resample : {multinomial, roulette, alias}) EXPECT_LT(worst_covariance_z(resample), 5.9);
  EXPECT_GT(worst_covariance_z(systematic), 5.9) << "the twin";
}

TEST(Schemes, AreFoundByName) {
  for (const Scheme& scheme : schemes()) EXPECT_EQ(find_scheme(scheme.name), &scheme);
  EXPECT_EQ(find_scheme("none"), nullptr);
  EXPECT_EQ(systematic_scheme().name, "systematic");
}

TEST(Schemes, AreAFunctionOfTheAddress) {
  for (const Scheme& scheme : schemes()) {
    EXPECT_EQ(offspring(scheme.resample, skewed(), 5), offspring(scheme.resample, skewed(), 5)) << scheme.name;
    EXPECT_NE(offspring(scheme.resample, skewed(), 5), offspring(scheme.resample, skewed(), 6)) << scheme.name;
  }
}

}  // namespace
}  // namespace mote
