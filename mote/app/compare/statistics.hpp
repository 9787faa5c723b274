#pragma once
/// Statistics of a comparison: middles, bootstrap intervals, the band of a chi-square.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mote::compare {

/// Ends of an interval; NaN where there is none.
struct Interval {
  double low, high;
};

/// The share of intervals that hold the true value.
inline constexpr double kConfidence = 0.95;
inline constexpr std::size_t kResamples = 1000;

/// Arithmetic mean; infinite when a value is.
///
/// shape   values: (n,), n >= 1
double mean(std::span<const double> values);

/// Middle value, of an even number the mean of the two in the middle; infinite when half of the values are.
///
/// shape   values: (n,), n >= 1
/// cost    O(n)
double median(std::vector<double> values);

/// Unbiased standard deviation within groups, pooled:
///
///   sd^2 = sum_k sum_r (v_kr - mean_k)^2 / (K (R - 1))
///
/// shape   values: (K R,), group by group; each = R
/// error   none; NaN when R = 1 or a value is infinite
double pooled_deviation(std::span<const double> values, std::size_t each);

/// How values are sampled: K groups (recordings) of R values each (repeats), value r of group k at k R + r.
struct Sampling {
  std::size_t groups, each;
};

/// A number computed from the values at the given places.
using Statistic = std::function<double(std::span<const std::size_t> places)>;

/// Percentile interval of a statistic by the bootstrap: K groups drawn with replacement, then R of each group's values
/// (a level of one alone is left as it is). Statistics of several contenders stay paired: they see the same places.
///
///   [q_(alpha/2), q_(1 - alpha/2)] of kResamples statistics, alpha = 1 - level
///
/// The draws are the same at every call, so an interval is a function of the values.
/// error   none; NaN ends when K R = 1 or a resampled statistic is NaN
/// cost    kResamples evaluations of the statistic
/// source  Efron & Tibshirani 1993, ch. 13; two levels: Davison & Hinkley 1997, sec. 3.8
Interval bootstrap(const Sampling& sampling, const Statistic& statistic, double level = kConfidence);

/// The value below which the sum of k squared standard normal numbers lies with probability p.
///
/// shape   k > 0, 0 < p < 1
double chi_square_quantile(double degrees_of_freedom, double probability);

/// Where the mean of k independent squares of standard normal numbers lies 95 times of 100.
///
///   chi^2_k / k at 2.5 % and 97.5 %
///
/// error   none; NaN ends for k = 0
Interval chi_square_band(double degrees_of_freedom);

}  // namespace mote::compare
