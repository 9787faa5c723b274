#include "mote/software/reference.hpp"

#include <gtest/gtest.h>

#include "mote/engine/run.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/linear_gaussian.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"
#include "mote/software/engines.hpp"

namespace mote {
namespace {

/// Means of x over five steps.
std::vector<double> means(const Plan& plan) {
  Recording recording;
  for (Step t = 1; t <= 5; ++t) recording.steps.push_back({t, {Row<double>::of({1.0 + t})}});
  const Ungm<1> model;
  const auto filter = reference_filter(model, plan, "mote run");
  RunRequest request;
  request.states = model.states();
  std::vector<double> all;
  for (const auto& row : run(*filter, plan, recording, request).rows) all.push_back(row.states[0].mean);
  return all;
}

std::vector<Plan> plans() {
  std::vector<Plan> all;
  for (const auto filter :
       {FilterKind::kSisr, FilterKind::kImh, FilterKind::kAuxiliary, FilterKind::kDistributed, FilterKind::kSqmc})
    for (const auto precision : {Precision::kDouble, Precision::kFloat})
      for (const char* proposal : {"prior", "observation", "observation-sum"}) {
        Plan plan;
        plan.filter = filter;
        plan.precision = precision;
        plan.proposal = proposal;
        plan.particles = 40;
        plan.groups.groups = 4;
        all.push_back(plan);
      }
  return all;
}

std::string text(const Plan& plan) {
  return std::string(name_of(plan.filter)) + ", " + plan.proposal +
         (plan.precision == Precision::kFloat ? ", float" : ", double");
}

TEST(Reference, TheSeedDecidesEveryBit) {
  for (Plan plan : plans()) {
    const auto first = means(plan);
    EXPECT_EQ(means(plan), first) << text(plan);
    plan.seed = 2;
    EXPECT_NE(means(plan), first) << text(plan);
  }
}

TEST(Reference, EveryChoiceOfAPlanReachesTheFilter) {
  std::vector<std::vector<double>> results;
  for (const Plan& plan : plans()) results.push_back(means(plan));
  for (std::size_t a = 0; a < results.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      // with g = p the auxiliary filter is the IMH filter
      const bool same_by_design = plans()[a].proposal == "prior" && plans()[a].filter == FilterKind::kAuxiliary &&
                                  plans()[b].proposal == "prior" && plans()[b].filter == FilterKind::kImh &&
                                  plans()[a].precision == plans()[b].precision;
      EXPECT_EQ(results[a] == results[b], same_by_design) << text(plans()[a]) << " and " << text(plans()[b]);
    }
}

/// A model that draws more numbers a step than Sobol' points have coordinates.
struct Spendthrift {
  template <class S>
  using State = std::array<S, 1>;
  std::vector<Quantity> states() const { return {{"x", ""}}; }
  std::vector<Column> columns() const { return {{"y", ""}}; }
  template <class S, class D>
  State<S> initial(D& draw) const {
    return {draw.normal()};
  }
  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    S sum = before[0];
    for (int i = 0; i < 4000; ++i) sum = sum + draw.normal();
    return {sum};
  }
  template <class S>
  S log_likelihood(Step, const State<S>&, const Row<S>&) const {
    return S(0);
  }
};

template <class M>
std::unique_ptr<Filter> filter_of(const M& model, const Plan& plan) {
  return reference_filter(model, plan, "mote run");
}
std::unique_ptr<Filter> filter_of(const Spendthrift& model, const Plan& plan) {
  return make_reference_filter(model, plan, "mote run");
}

template <class M>
std::string refusal(const M& model, FilterKind filter, const std::string& proposal) {
  Plan plan;
  plan.filter = filter;
  plan.proposal = proposal;
  plan.particles = 10;
  try {
    EXPECT_NE(filter_of(model, plan), nullptr);
  } catch (const Refusal& r) {
    EXPECT_EQ(r.code(), ExitCode::kWrongUse);
    return r.what();
  }
  return "";
}

TEST(Reference, RefusesAProposalThatTheModelDoesNotHave) {
  EXPECT_NE(refusal(Ungm<1>{}, FilterKind::kSisr, "optimal").find("--proposal"), std::string::npos);
  EXPECT_NE(refusal(Doa{}, FilterKind::kSisr, "wide").find("Pass --proposal prior"), std::string::npos);
}

TEST(Reference, RefusesAProposalWithoutDensity) {
  for (const auto filter : {FilterKind::kSisr, FilterKind::kImh, FilterKind::kAuxiliary, FilterKind::kSqmc}) {
    EXPECT_NE(refusal(Ungm<1>{{0.5, 1.2, 0, 1, 5}}, filter, "observation").find("no transition density"),
              std::string::npos);
    EXPECT_NE(refusal(LocalLevel{{0, 1, 0, 1}}, filter, "optimal").find("no transition density"), std::string::npos);
    EXPECT_EQ(refusal(Ungm<1>{{0.5, 1.2, 0, 1, 5}}, filter, "prior"), "") << "the prior needs none";
  }
  LinearGaussianParameters p;
  p.F = p.covariance = Eigen::MatrixXd::Identity(2, 2);
  p.Q = Eigen::MatrixXd::Ones(2, 2);  // rank one
  p.H = Eigen::MatrixXd::Ones(1, 2);
  p.R = Eigen::MatrixXd::Ones(1, 1);
  p.mean = Eigen::VectorXd::Zero(2);
  EXPECT_NE(refusal(LinearGaussian(p), FilterKind::kSisr, "optimal").find("no transition density"), std::string::npos);
}

TEST(Reference, KalmanFiltersAreTheSameForEverySeedAndPrecision) {
  for (const auto filter : {FilterKind::kEkf, FilterKind::kUkf}) {
    Plan plan;
    plan.filter = filter;
    const auto first = means(plan);
    plan.seed = 2;
    plan.precision = Precision::kFloat;
    plan.particles = 10;
    const auto second = means(plan);
    for (std::size_t k = 0; k < first.size(); ++k) EXPECT_NEAR(second[k], first[k], 1e-12);
  }
  Plan ekf;
  ekf.filter = FilterKind::kEkf;
  Plan ukf;
  ukf.filter = FilterKind::kUkf;
  EXPECT_NE(means(ekf), means(ukf));
}

TEST(Reference, RefusesKalmanFiltersOfOtherThanGaussianNoise) {
  Bearings heavy;
  heavy.p.dof = 3;
  for (const auto filter : {FilterKind::kEkf, FilterKind::kUkf}) {
    EXPECT_NE(refusal(heavy, filter, "prior").find("whose noise is Gaussian"), std::string::npos);
    EXPECT_NE(refusal(Spendthrift{}, filter, "prior").find("without observe()"), std::string::npos);
    EXPECT_EQ(refusal(Bearings{}, filter, "prior"), "");
    EXPECT_EQ(refusal(Doa{}, filter, "prior"), "");
  }
}

TEST(Reference, RefusesMoreDrawsThanPointsHaveCoordinates) {
  EXPECT_NE(refusal(Spendthrift{}, FilterKind::kSqmc, "prior").find("3667"), std::string::npos);
  EXPECT_EQ(refusal(Spendthrift{}, FilterKind::kSisr, "prior"), "");
}

TEST(Reference, RefusesMixtureSumsOverNoiseDensities) {
  EXPECT_NE(refusal(Bearings{}, FilterKind::kImh, "wide").find("--filter auxiliary"), std::string::npos);
  EXPECT_EQ(refusal(Bearings{}, FilterKind::kAuxiliary, "wide"), "");
  EXPECT_EQ(refusal(Bearings{}, FilterKind::kSisr, "wide"), "");
  EXPECT_EQ(refusal(Bearings{}, FilterKind::kSqmc, "wide"), "");
  EXPECT_EQ(refusal(Bearings{}, FilterKind::kImh, "prior"), "");
}

}  // namespace
}  // namespace mote
