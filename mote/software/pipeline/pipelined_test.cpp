#include "mote/software/pipeline/pipelined.hpp"

#include <gtest/gtest.h>

#include "mote/engine/checkpoint_laws.hpp"
#include "mote/engine/drawn_recording.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/linear_gaussian.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"
#include "mote/software/engines.hpp"

namespace mote {
namespace {

template <class M>
RunRequest request_for(const M& model) {
  RunRequest request;
  request.states = model.states();
  return request;
}

/// Bits of all particles after the last step, and all rows.
struct Told {
  RunRecord record;
  std::vector<double> particles, weights;
};

Told told(Filter& filter, const Plan& plan, const Recording& recording, const RunRequest& request) {
  Told all{run(filter, plan, recording, request), {}, {}};
  const WeightedSet set = filter.weighted();
  set.visit([&](const auto& x) {
    for (std::size_t d = 0; d < x.dimensions(); ++d)
      for (const auto v : x.component(d)) all.particles.push_back(static_cast<double>(v));
  });
  all.weights.assign(set.weights.begin(), set.weights.end());
  return all;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return laws::same(x, y); });
}

std::string difference(const Told& a, const Told& b) {
  if (a.record.rows.size() != b.record.rows.size()) return "another number of rows";
  for (std::size_t k = 0; k < a.record.rows.size(); ++k)
    if (!laws::same(a.record.rows[k], b.record.rows[k]))
      return "another estimate at t = " + std::to_string(a.record.rows[k].t);
  if (!same_bits(a.particles, b.particles)) return "another particle in the end";
  return same_bits(a.weights, b.weights) ? "" : "another weight in the end";
}

const std::vector<PipelineSize> kSizes{
    {1, 1, 1, 1, 0, {}}, {2, 1, 1, 2, 16, {}}, {1, 3, 2, 3, 64, {}}, {3, 2, 4, 4, 256, {}}, {2, 2, 64, 2, 1024, {}}};

template <class M>
void expect_the_reference(const M& model, const Plan& plan, const std::string& what,
                          const std::vector<PipelineSize>& sizes = kSizes) {
  const Recording recording = drawn_recording(model, 6);
  const RunRequest request = request_for(model);
  const auto reference = reference_filter(model, plan, "test");
  const Told expected = told(*reference, plan, recording, request);
  for (const PipelineSize& size : sizes) {
    const auto pipelined = pipeline_filter(model, plan, "test", size);
    EXPECT_EQ(difference(told(*pipelined, plan, recording, request), expected), "")
        << what << ", Rp = " << size.proposers << ", Rw = " << size.weighers << ", lines " << size.chains
        << ", threads " << size.threads << ", block " << size.block;
  }
}

Plan plan_of(FilterKind filter, std::size_t particles, Precision precision = Precision::kDouble) {
  Plan plan;
  plan.filter = filter;
  plan.particles = particles;
  plan.precision = precision;
  plan.seed = 3;
  plan.on_collapse = OnCollapse::kKeep;
  return plan;
}

constexpr FilterKind kFilters[] = {FilterKind::kSisr, FilterKind::kImh, FilterKind::kAuxiliary};

// claim    the pipeline's results are the reference's, bit by bit, for any Rp, Rw, threads and block
// referee  the reference engine
// design   every model and proposal of the catalogue, float and double, fewer particles than a block and a number that
//          is no multiple of one; the twin draws by another seed
template <class M>
void expect_the_reference_of_all(const M& model, std::vector<std::string> proposals, std::size_t particles) {
  for (const FilterKind filter : kFilters)
    for (const std::string& proposal : proposals)
      for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
        Plan plan = plan_of(filter, particles, precision);
        plan.proposal = proposal;
        if (proposal != "prior" && filter == FilterKind::kImh) {
          if (density_of(model) != Density::kState) continue;
          plan.particles = std::min<std::size_t>(particles, 100);  // weights sum over all parents
        }
        expect_the_reference(
            model, plan,
            std::string(name_of(filter)) + ", " + proposal + (precision == Precision::kFloat ? ", float" : ", double"));
      }
}

TEST(PipelinedFilter, IsTheReferenceOnTheGrowthModel) {
  expect_the_reference_of_all(Ungm<1>{}, {"prior", "observation", "observation-sum"}, 2500);
  expect_the_reference_of_all(Ungm<2>{}, {"prior"}, 700);
}
TEST(PipelinedFilter, IsTheReferenceOnBearings) {
  expect_the_reference_of_all(Bearings{}, {"prior", "wide", "guided"}, 1100);
  Bearings heavy;
  heavy.p.dof = 3;
  expect_the_reference_of_all(heavy, {"prior"}, 300);
}
TEST(PipelinedFilter, IsTheReferenceOnDirectionsOfArrival) {
  Doa doa;
  doa.frame = 3;
  expect_the_reference_of_all(doa, {"prior", "guided"}, 700);
}
TEST(PipelinedFilter, IsTheReferenceOnLinearModels) {
  expect_the_reference_of_all(LocalLevel{}, {"prior", "optimal", "guided"}, 1025);
  LinearGaussianParameters p;
  p.F = p.covariance = p.Q = Eigen::MatrixXd::Identity(2, 2);
  p.H = Eigen::MatrixXd::Ones(1, 2);
  p.R = Eigen::MatrixXd::Ones(1, 1);
  p.mean = Eigen::VectorXd::Zero(2);
  expect_the_reference_of_all(LinearGaussian(p), {"prior", "optimal"}, 600);
}

TEST(PipelinedFilter, TwinAnotherSeedIsCaught) {
  const Ungm<1> model;
  Plan plan = plan_of(FilterKind::kImh, 100);
  const auto reference = reference_filter(model, plan, "test");
  plan.seed = 4;
  const auto pipelined = pipeline_filter(model, plan, "test");
  EXPECT_NE(difference(told(*pipelined, plan, drawn_recording(model, 6), request_for(model)),
                       told(*reference, plan, drawn_recording(model, 6), request_for(model))),
            "");
}

TEST(PipelinedFilter, IsTheReferenceForEveryKindOfChain) {
  const Ungm<1> model;
  std::vector<ChainOptions> options{{.draws = 1500, .burn_in = 30},
                                    {.draws = 1300, .burn_in = 7, .chains = 5},
                                    {.burn_in = 100, .chains = 3, .start = ChainStart::kWeighted},
                                    {.burn_in = std::nullopt},
                                    {.burn_in = std::nullopt, .chains = 4, .parents = Parents::kPermuted},
                                    {.chains = 8, .parents = Parents::kPermuted, .start = ChainStart::kWeighted},
                                    {.chains = 2, .parents = Parents::kSweep},
                                    {.chains = 1200}};
  for (const FilterKind filter : {FilterKind::kImh, FilterKind::kAuxiliary})
    for (const Precision precision : {Precision::kDouble, Precision::kFloat})
      for (std::size_t k = 0; k < options.size(); ++k) {
        Plan plan = plan_of(filter, 1200, precision);
        plan.chain = options[k];
        expect_the_reference(model, plan, "options " + std::to_string(k));
        if (filter != FilterKind::kAuxiliary) continue;
        plan.chain.parent_weights = ParentWeights::kLookahead;
        plan.proposal = "observation";
        expect_the_reference(model, plan, "lookahead, options " + std::to_string(k));
      }
}

TEST(PipelinedFilter, IsTheReferenceForEveryKindOfSelection) {
  const Bearings model;
  for (const Scheme& scheme : schemes())
    for (const double threshold : {1.0, 0.5, 0.0}) {
      Plan plan = plan_of(FilterKind::kSisr, 1100);
      plan.selection = {&scheme, threshold, threshold == 0.5 ? 0.7 : 1};
      expect_the_reference(model, plan, std::string(scheme.name), {kSizes[2], kSizes[3]});
    }
}

TEST(PipelinedFilter, IsTheReferenceForFewParticles) {
  for (const FilterKind filter : kFilters)
    for (const std::size_t particles : {1U, 2U, 15U, 16U, 17U})
      expect_the_reference(LocalLevel{}, plan_of(filter, particles), std::to_string(particles) + " particles");
}

/// The local level, seen at t = 3 where no particle can be.
Recording hopeless(const LocalLevel& model, double where) {
  Recording recording = drawn_recording(model, 6);
  for (ObservedStep& step : recording.steps)
    if (step.t == 3) step.rows.front().values.front() = where;
  return recording;
}

TEST(PipelinedFilter, RecoversFromACollapseAsTheReferenceDoes) {
  const LocalLevel model;
  const Recording recording = hopeless(model, 1e200);
  for (const FilterKind filter : kFilters)
    for (const OnCollapse what : {OnCollapse::kKeep, OnCollapse::kReset})
      for (const ChainStart start : {ChainStart::kFirst, ChainStart::kWeighted}) {
        Plan plan = plan_of(filter, 700);
        plan.on_collapse = what;
        plan.chain.chains = 3;
        plan.chain.start = start;
        const auto reference = reference_filter(model, plan, "test");
        const auto pipelined = pipeline_filter(model, plan, "test", kSizes[3]);
        const Told expected = told(*reference, plan, recording, request_for(model));
        EXPECT_TRUE(expected.record.rows[2].report.collapsed);
        EXPECT_EQ(difference(told(*pipelined, plan, recording, request_for(model)), expected), "");
      }
}

TEST(PipelinedFilter, StopsAtACollapse) {
  const LocalLevel model;
  for (const FilterKind filter : kFilters) {
    Plan plan = plan_of(filter, 700);
    plan.on_collapse = OnCollapse::kStop;
    const auto pipelined = pipeline_filter(model, plan, "test", kSizes[3]);
    try {
      run(*pipelined, plan, hopeless(model, 1e200), request_for(model));
      ADD_FAILURE() << "went on";
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kCollapsed);
    }
  }
}

TEST(PipelinedFilter, IsResumedBitByBit) {
  const Ungm<1> model;
  for (const FilterKind filter : kFilters)
    for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
      Plan plan = plan_of(filter, 300, precision);
      plan.chain.chains = 2;
      const auto make = [&] { return pipeline_filter(model, plan, "test", kSizes[3]); };
      EXPECT_EQ(laws::broken_promise(make, plan, drawn_recording(model, 6), request_for(model)), "");
    }
}

TEST(PipelinedFilter, LeavesTheRecordOfItsStages) {
  const Ungm<1> model;
  Plan plan = plan_of(FilterKind::kImh, 500);
  plan.proposers = 2;
  plan.weighers = 3;
  plan.threads = 2;
  plan.chain.chains = 4;
  const auto pipelined = pipeline_filter(model, plan, "test");
  const RunRecord record = run(*pipelined, plan, drawn_recording(model, 6), request_for(model));
  ASSERT_TRUE(record.stages);
  EXPECT_EQ(record.stages->stages[0].workers.size(), 2U);
  EXPECT_EQ(record.stages->stages[1].workers.size(), 3U);
  EXPECT_EQ(record.stages->stages[2].workers.size(), 4U);
  const auto reference = reference_filter(model, plan, "test");
  EXPECT_FALSE(run(*reference, plan, drawn_recording(model, 6), request_for(model)).stages);
}

TEST(PipelinedFilter, RefusesAProposalThatTheModelDoesNotHave) {
  Plan plan = plan_of(FilterKind::kSisr, 10);
  plan.proposal = "optimal";
  EXPECT_THROW(pipeline_filter(Ungm<1>{}, plan, "test"), Refusal);
}

}  // namespace
}  // namespace mote
