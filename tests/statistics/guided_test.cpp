#include <gtest/gtest.h>

#include "mote/model/bearings.hpp"
#include "mote/referee/kalman.hpp"
#include "tests/statistics/linear_models.hpp"
#include "tests/statistics/makers.hpp"

namespace mote::statistics {
namespace {

/// A target that manoeuvres by 0.25 m within a step, seen by two sensors 4 m away.
Bearings manoeuvring(double sigma_r) {
  Bearings model;
  model.p = {.sigma_u = 0.5, .sigma_r = sigma_r, .damping = 0.8, .x0 = 3, .y0 = 3, .sd_x = 0.3, .sd_y = 0.3};
  return model;
}
Recording manoeuvres(const Bearings& model) {
  Simulated<Bearings> all = simulate(model, 12, 41);
  auto block = Draws{42, 0}.block(Purpose::kTest);
  auto draw = block.particle(0);
  Row<double> sensor = blank_row(model);
  sensor.values = {kNaN, 6, 0, 1.5};
  for (std::size_t k = 0; k < all.truth.size(); ++k)
    all.recording.steps[k].rows.push_back(model.observe<double>(static_cast<Step>(k) + 1, all.truth[k], sensor, draw));
  return all.recording;
}

/// Guided, but weighed as if the model itself had moved the particles.
struct Unweighed : Guided {
  template <class S, HasNoise M>
  S log_density(const M& model, Step t, const StateOf<M, S>& x, const StateOf<M, S>& before, Rows<S>) const {
    return model.template log_transition<S>(t, x, before);
  }
};

/// Guided by bearings that are 0.2 rad off, and weighed rightly.
struct Misled {
  template <class S>
  static std::vector<Row<S>> turned(Rows<S> y) {
    std::vector<Row<S>> rows(y.begin(), y.end());
    for (Row<S>& row : rows) row.values[0] = row.values[0] + S(0.2);
    return rows;
  }
  template <class S, class M, class D>
  StateOf<M, S> propose(const M& model, Step t, const StateOf<M, S>& before, Rows<S> y, D& draw) const {
    return Guided{}.propose<S>(model, t, before, Rows<S>(turned<S>(y)), draw);
  }
  template <class S, class M>
  S log_density(const M& model, Step t, const StateOf<M, S>& x, const StateOf<M, S>& before, Rows<S> y) const {
    return Guided{}.log_density<S>(model, t, x, before, Rows<S>(turned<S>(y)));
  }
};

template <class G, Model M>
Maker sisr_by(const M& model) {
  return {"sisr", [=](std::size_t n, std::uint64_t seed) { return make_sisr<double, G>(model, n, seed); }};
}

// claim    a guided filter's evidence is unbiased, by importance weights and by chains
// referee  the Kalman filter, exact for this model
// design   4000 clouds of 64 particles along the local level with holes and double rows, seeds 1..4000
// risk     1e-6 (|z| < 4.89); the twin, proposals weighed as if they were the prior's, must fail
TEST(GuidedFilters, EvidenceOfTheLocalLevelIsUnbiased) {
  const LocalLevel model = local_level();
  const auto recording = local_level_recording();
  const double exact = referee::log_evidence(referee::kalman(model, recording));
  const auto z = [&](const Maker& maker) {
    return evidence_ratios(maker, model.states(), recording, 64, 4000, exact).z(1);
  };
  EXPECT_LT(std::abs(z(sisr_by<Guided>(model))), kOneInAMillion);
  const ChainOptions start{.start = ChainStart::kWeighted};
  EXPECT_LT(std::abs(z({"auxiliary",
                        [&](std::size_t n, std::uint64_t seed) {
                          return make_auxiliary<double, Guided>(model, n, seed, start);
                        }})),
            kOneInAMillion);
  EXPECT_GT(std::abs(z(sisr_by<Unweighed>(model))), kOneInAMillion) << "the twin";
}

// claim    the same in noise space, where the innovations bend: the guide and the prior agree on the evidence
// referee  SISR by the prior with 100 000 particles, 20 runs
// design   two sensors of 1.1 degrees, 12 steps; 1000 clouds of 200 particles, seeds 1..1000; z of the difference of
// the mean ratios risk     1e-6 (|z| < 4.89); the twin, proposals weighed as if they were the prior's, must fail
TEST(GuidedFilters, EvidenceOfBearingsIsThatOfTheLargeFilter) {
  const Bearings model = manoeuvring(0.02);
  const Recording recording = manoeuvres(model);
  const double about = trace(*make_sisr(model, 100000, 500), model.states(), recording).log_evidence;
  const auto ratios = [&](const Maker& maker, std::size_t particles, std::size_t runs) {
    return evidence_ratios(maker, model.states(), recording, particles, runs, about);
  };
  const Sample referee = ratios(sisr_by<Prior>(model), 100000, 20);
  const auto z = [&](const Sample& got) {
    return (got.mean() - referee.mean()) / std::hypot(got.error(), referee.error());
  };
  const Sample guided = ratios(sisr_by<Guided>(model), 200, 1000);
  measured("bearings, guided, N = 200: mean ratio of the evidence", guided.mean(), guided.error());
  measured("bearings, prior, N = 100000: mean ratio of the evidence", referee.mean(), referee.error());
  EXPECT_LT(std::abs(z(guided)), kOneInAMillion);
  EXPECT_GT(std::abs(z(ratios(sisr_by<Unweighed>(model), 200, 1000))), kOneInAMillion) << "the twin";
}

/// Mean effective sample size, and mean square error of the position against a reference, over runs.
struct Merit {
  double ess, square_error;
};
template <class G>
Merit merit(const Bearings& model, const Recording& recording, const Trace& reference, std::size_t particles) {
  Sample ess;
  Sample squares;
  RunRequest request;
  request.states = model.states();
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto filter = make_sisr<double, G>(model, particles, seed, {}, OnCollapse::kReset);
    const RunRecord record = run(*filter, Plan{}, recording, request);
    for (std::size_t k = 0; k < record.rows.size(); ++k) {
      ess.values.push_back(record.rows[k].report.ess);
      squares.values.push_back(std::pow(record.rows[k].states[0].mean - reference.means[k][0], 2) +
                               std::pow(record.rows[k].states[2].mean - reference.means[k][2], 2));
    }
  }
  return {ess.mean(), squares.mean()};
}

// claim    where a step's noise is wide and the sensors are sharp, 200 guided particles do what thousands of the
//          prior's do: ten times the effective size, a hundredth of the mean square error
// referee  SISR by the prior with 200 000 particles
// design   two sensors of 0.3 degrees, 12 steps, 50 runs of 200 particles
// risk     figures of a fixed seed with a margin of two; the twin, guided by bearings 0.2 rad off, must not have the
// gain
TEST(GuidedFilters, DoWithFewParticlesWhatThePriorDoesWithMany) {
  const Bearings model = manoeuvring(0.005);
  const Recording recording = manoeuvres(model);
  const Trace reference = trace(*make_sisr(model, 200000, 501), model.states(), recording);
  const Merit prior = merit<Prior>(model, recording, reference, 200);
  const Merit guided = merit<Guided>(model, recording, reference, 200);
  const Merit misled = merit<Misled>(model, recording, reference, 200);
  const Merit many = merit<Prior>(model, recording, reference, 5000);
  measured("bearings, prior, N = 200: mean ESS", prior.ess, 0);
  measured("bearings, guided, N = 200: mean ESS", guided.ess, 0);
  measured("bearings, misled, N = 200: mean ESS", misled.ess, 0);
  measured("bearings, prior, N = 200: RMS distance to the posterior mean [mm]", 1e3 * std::sqrt(prior.square_error), 0);
  measured("bearings, prior, N = 5000: RMS distance to the posterior mean [mm]", 1e3 * std::sqrt(many.square_error), 0);
  measured("bearings, guided, N = 200: RMS distance to the posterior mean [mm]", 1e3 * std::sqrt(guided.square_error),
           0);
  measured("bearings, misled, N = 200: RMS distance to the posterior mean [mm]", 1e3 * std::sqrt(misled.square_error),
           0);
  EXPECT_GT(guided.ess, 10 * prior.ess);
  EXPECT_LT(guided.square_error, prior.square_error / 100);
  EXPECT_LT(guided.square_error, many.square_error);
  EXPECT_LT(misled.ess, prior.ess) << "the twin";
}

}  // namespace
}  // namespace mote::statistics
