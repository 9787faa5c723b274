#include "mote/software/simd/metropolis.hpp"

#include <gtest/gtest.h>

#include "mote/filter/imh.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"
#include "mote/referee/kalman.hpp"

namespace mote {
namespace {

/// Rows that a model draws itself, one a step.
template <class M>
std::vector<Row<double>> drawn_rows(const M& model, Step steps) {
  std::vector<Row<double>> rows;
  auto prior = Draws{7, 0}.block(Purpose::kTruth);
  auto first = prior.particle(0);
  auto x = model.template initial<double>(first);
  for (Step t = 1; t <= steps; ++t) {
    auto block = Draws{7, static_cast<std::uint32_t>(t)}.block(Purpose::kTruth);
    auto draw = block.particle(0);
    x = model.template next<double>(t, x, draw);
    rows.push_back(model.template observe<double>(t, x, blank_row(model), draw));
  }
  return rows;
}

/// What is compared of a step.
struct Told {
  StepReport report;
  std::vector<Moments> moments;
};

/// Runs a filter over the rows; every fifth step goes without its row.
std::vector<Told> run(Filter& filter, const std::vector<Row<double>>& rows, std::size_t dimensions) {
  std::vector<Told> all;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Step t = static_cast<Step>(k) + 1;
    Told told;
    told.report = t % 5 == 0 ? filter.predict(t) : filter.update(t, {&rows[k], 1});
    for (std::size_t d = 0; d < dimensions; ++d) told.moments.push_back(filter.moments(d, false));
    filter.select(t, told.report);
    all.push_back(told);
  }
  return all;
}

/// Largest difference of two runs' estimates, in standard deviations, of their evidence and of their acceptance.
double difference(const std::vector<Told>& a, const std::vector<Told>& b) {
  double worst = 0;
  const auto note = [&](double x, double y, double unit) {
    if (std::isnan(x) != std::isnan(y)) worst = kInfinity;
    if (!std::isnan(x) && x != y) worst = std::max(worst, std::abs(x - y) / unit);
  };
  for (std::size_t t = 0; t < a.size(); ++t) {
    EXPECT_EQ(a[t].report.selected, b[t].report.selected) << t;
    EXPECT_EQ(a[t].report.collapsed, b[t].report.collapsed) << t;
    EXPECT_EQ(a[t].report.burn_in, b[t].report.burn_in) << t;
    note(a[t].report.log_evidence, b[t].report.log_evidence, 1);
    note(a[t].report.acceptance, b[t].report.acceptance, 1);
    note(a[t].report.ess, b[t].report.ess, b[t].report.ess);
    for (std::size_t d = 0; d < a[t].moments.size(); ++d) {
      note(a[t].moments[d].mean, b[t].moments[d].mean, b[t].moments[d].sd);
      note(a[t].moments[d].sd, b[t].moments[d].sd, b[t].moments[d].sd);
    }
  }
  return worst;
}

struct Case {
  std::size_t particles;
  ChainOptions options;
};
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::size_t chains : {1, 2, 7, 8, 15, 16, 17, 33, 64}) all.push_back({3000, {.chains = chains}});
  for (const std::size_t particles : {1, 5, 16, 63, 1023, 1024, 1025})
    all.push_back({particles, {.chains = std::min<std::size_t>(particles, 5)}});
  for (const auto parents : {mote::Parents::kIid, mote::Parents::kPermuted, mote::Parents::kSweep})
    for (const auto start : {ChainStart::kFirst, ChainStart::kWeighted})
      all.push_back({700, {.draws = 1500, .burn_in = 21, .chains = 19, .parents = parents, .start = start}});
  return all;
}
std::string text(const Case& c) {
  return "N " + std::to_string(c.particles) + ", P " + std::to_string(c.options.chains) + ", parents " +
         std::to_string(static_cast<int>(c.options.parents)) + ", start " +
         std::to_string(static_cast<int>(c.options.start));
}

template <class R, class G = Prior, class M>
void expect_reference(const M& model, Step steps, double tolerance) {
  const auto rows = drawn_rows(model, steps);
  for (const Case& c : cases()) {
    const auto reference = make_auxiliary<R, G>(model, c.particles, 3, c.options);
    VectorMetropolisFilter<M, R, G> vectors(model, c.particles, 3, c.options, OnCollapse::kStop, 1);
    const std::size_t dimensions = model.states().size();
    EXPECT_LT(difference(run(vectors, rows, dimensions), run(*reference, rows, dimensions)), tolerance) << text(c);
  }
}

TEST(VectorMetropolis, IsTheReferenceStepByStep) {
  expect_reference<double>(Ungm<1>{}, 12, 1e-5);
  expect_reference<double>(Bearings{}, 12, 1e-4);
}

}  // namespace
}  // namespace mote
