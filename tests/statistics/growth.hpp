#pragma once
/// The growth model against its exact posterior: paired errors of filters over many recordings.

#include "mote/model/ungm.hpp"
#include "mote/referee/grid.hpp"
#include "tests/statistics/makers.hpp"

namespace mote::statistics {

/// Mean square errors to the exact mean, by filter and recording; the first filter is SISR.
struct PairedErrors {
  std::vector<std::string> names;
  std::vector<Sample> squares;

  /// Root mean square errors of filter i, one a recording.
  Sample rmse(std::size_t i) const {
    Sample roots;
    for (const double v : squares[i].values) roots.values.push_back(std::sqrt(v));
    return roots;
  }
  double ratio_of_medians(std::size_t i) const { return squares[i].median() / squares[0].median(); }
  double median_ratio(std::size_t i) const { return ratios(i).median(); }
  Sample ratios(std::size_t i) const {
    Sample all;
    for (std::size_t r = 0; r < squares[i].values.size(); ++r)
      all.values.push_back(squares[i].values[r] / squares[0].values[r]);
    return all;
  }
  /// Standard error of the log of the ratio of medians, by 200 resamplings of the recordings.
  double relative_error(std::size_t i) const {
    Sample logs;
    for (std::uint64_t b = 1; b <= 200; ++b) {
      PairedErrors drawn{{}, {{}, {}}};
      Draws{b, 0}.for_each(Purpose::kTest, 0, squares[i].values.size(), [&](std::size_t, auto& draw) {
        const std::size_t r = draw.index(squares[i].values.size());
        drawn.squares[0].values.push_back(squares[0].values[r]);
        drawn.squares[1].values.push_back(squares[i].values[r]);
      });
      logs.values.push_back(std::log(drawn.ratio_of_medians(1)));
    }
    return std::sqrt(logs.variance());
  }
};

/// Simulates `recordings` recordings of 100 steps (seeds 1, 2, ...) and runs every filter once along each, N = 1000;
/// the exact posterior of a recording is computed once, whatever the number of filters.
inline PairedErrors paired_errors(const std::vector<Maker>& makers, std::size_t recordings) {
  const Ungm<1> model;
  referee::Grid grid(model);
  PairedErrors all;
  for (const Maker& maker : makers) all.names.push_back(maker.name);
  all.squares.resize(makers.size());
  for (std::uint64_t r = 1; r <= recordings; ++r) {
    const Recording recording = simulate(model, 100, r).recording;
    const referee::GridResult exact = grid.filter(recording);
    for (std::size_t i = 0; i < makers.size(); ++i) {
      const auto filter = makers[i].make(1000, r);
      all.squares[i].values.push_back(mean_square_error(trace(*filter, model.states(), recording), exact.means));
    }
  }
  return all;
}

/// SISR first, then the papers' filter and the improved one.
inline std::vector<Maker> growth_filters() {
  const Ungm<1> model;
  return {{"sisr", [=](std::size_t n, std::uint64_t seed) { return make_sisr(model, n, seed); }},
          {"imh, one chain", [=](std::size_t n, std::uint64_t seed) { return make_imh(model, n, seed); }},
          {"imh, 8 chains, permuted, weighted start",
           [=](std::size_t n, std::uint64_t seed) { return make_imh(model, n, seed, improved()); }}};
}

inline void print(const PairedErrors& errors) {
  const std::string many = std::to_string(errors.squares[0].values.size()) + " recordings: ";
  for (std::size_t i = 0; i < errors.names.size(); ++i) {
    measured("ungm, N = 1000, " + many + "RMSE to the exact mean, " + errors.names[i], errors.rmse(i).mean(),
             errors.rmse(i).error());
    if (i == 0) continue;
    const double ratio = errors.ratio_of_medians(i);
    measured("ungm, " + many + "median MSE / median MSE of sisr, " + errors.names[i], ratio,
             ratio * errors.relative_error(i));
    measured("ungm, " + many + "median of the ratio of MSEs, " + errors.names[i], errors.median_ratio(i),
             ratio * errors.relative_error(i));
  }
}

}  // namespace mote::statistics
