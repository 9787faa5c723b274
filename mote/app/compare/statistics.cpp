#include "mote/app/compare/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/chi_squared.hpp>

#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"

namespace mote::compare {
namespace {

/// The places of one resample.
void draw_places(const Sampling& sampling, Draw<double>& draw, std::vector<std::size_t>& places) {
  places.clear();
  for (std::size_t k = 0; k < sampling.groups; ++k) {
    const std::size_t group = sampling.groups == 1 ? 0 : draw.index(sampling.groups);
    for (std::size_t r = 0; r < sampling.each; ++r)
      places.push_back(group * sampling.each + (sampling.each == 1 ? 0 : draw.index(sampling.each)));
  }
}

/// The value of a sorted list whose rank is nearest to a share of the way.
double ranked(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

}  // namespace

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  if (values.size() % 2 == 1) return *half;
  return 0.5 * (*std::max_element(values.begin(), half) + *half);
}

double pooled_deviation(std::span<const double> values, std::size_t each) {
  double squares = 0;
  double freedom = 0;
  for (std::size_t first = 0; first < values.size(); first += each) {
    const auto group = values.subspan(first, each);
    const double middle = mean(group);
    for (const double v : group) squares += (v - middle) * (v - middle);
    freedom += static_cast<double>(each - 1);
  }
  return std::sqrt(squares / freedom);
}

Interval bootstrap(const Sampling& sampling, const Statistic& statistic, double level) {
  if (sampling.groups * sampling.each < 2) return {kNaN, kNaN};
  std::vector<double> values;
  std::vector<std::size_t> places;
  for (std::size_t b = 0; b < kResamples; ++b) {
    auto block = Draws{1, static_cast<std::uint32_t>(b)}.block(Purpose::kBootstrap);
    auto draw = block.particle(0);
    draw_places(sampling, draw, places);
    values.push_back(statistic(places));
    if (std::isnan(values.back())) return {kNaN, kNaN};
  }
  std::sort(values.begin(), values.end());
  return {ranked(values, 0.5 * (1 - level)), ranked(values, 0.5 * (1 + level))};
}

double chi_square_quantile(double degrees_of_freedom, double probability) {
  return boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

Interval chi_square_band(double degrees_of_freedom) {
  const double k = degrees_of_freedom;
  if (!(k > 0)) return {kNaN, kNaN};
  return {chi_square_quantile(k, 0.5 * (1 - kConfidence)) / k, chi_square_quantile(k, 0.5 * (1 + kConfidence)) / k};
}

}  // namespace mote::compare
