#include "mote/engine/checkpoint.hpp"

#include <gtest/gtest.h>

#include "mote/engine/checkpoint_laws.hpp"
#include "mote/filter/imh.hpp"
#include "mote/filter/kalman.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/filter/sqmc.hpp"
#include "mote/model/ungm.hpp"

namespace mote {
namespace {

using Make = std::function<std::unique_ptr<Filter>()>;

constexpr std::size_t kParticles = 300;
const Ungm<1> kModel;

/// Gaps, a step without rows, one with two, and one that no particle explains.
Recording recording() {
  Recording all;
  const auto seen = [](double y) { return Row<double>::of({y}); };
  all.steps = {{2, {seen(3)}},     {3, {seen(0.1)}}, {4, {}},         {7, {seen(1), seen(2)}},
               {8, {seen(1e160)}}, {9, {seen(12)}},  {11, {seen(4)}}, {12, {seen(0)}}};
  return all;
}

std::string broken_promise(const Make& make) {
  Plan plan;
  plan.particles = kParticles;
  plan.on_collapse = OnCollapse::kKeep;
  RunRequest request;
  request.states = kModel.states();
  request.sources = value_sources(kModel);
  request.estimands = {parse_estimand("q0.9(x)", request.sources, "")};
  return laws::broken_promise(make, plan, recording(), request);
}

template <class R>
std::vector<Make> all_filters(OnCollapse c) {
  constexpr std::size_t n = kParticles;
  std::vector<Make> all{[=] { return make_sqmc<R>(kModel, n, 2, c); }};
  for (const SelectionOptions& selection :
       {SelectionOptions{}, SelectionOptions{.ess_threshold = 0.5},
        SelectionOptions{.scheme = find_scheme("residual"), .ess_threshold = 0.7, .exponent = 0.5}}) {
    all.push_back([=] { return make_sisr<R>(kModel, n, 2, selection, c); });
    for (const Exchange exchange : {Exchange::kNone, Exchange::kAppend, Exchange::kReplace, Exchange::kSwap})
      for (const bool carry : {true, false})
        all.push_back([=] {
          return make_distributed<R>(
              kModel, n, 2, {.groups = 4, .exchange = exchange, .exchange_count = 3, .carry_group_weights = carry},
              selection, c);
        });
    for (const GroupResampling resampling : {GroupResampling::kGlobal, GroupResampling::kProportional,
                                             GroupResampling::kNonProportional, GroupResampling::kChain})
      all.push_back([=] {
        return make_distributed<R>(kModel, n, 2,
                                   {.groups = 4,
                                    .resampling = resampling,
                                    .exchange_count = 3,
                                    .topology = Topology::kHypercube,
                                    .exchange_every = 2},
                                   selection, c);
      });
    all.push_back([=] {
      return make_distributed<R>(
          kModel, n, 2,
          {.groups = 4, .exchange = Exchange::kSwap, .topology = Topology::kHypercube, .exchange_when = 0.9}, selection,
          c);
    });
  }
  for (const ChainOptions& chain :
       {ChainOptions{}, ChainOptions{.draws = 500, .burn_in = std::nullopt, .chains = 3, .parents = Parents::kPermuted},
        ChainOptions{.burn_in = 9, .chains = 8, .parents = Parents::kSweep, .start = ChainStart::kWeighted},
        ChainOptions{.parent_weights = ParentWeights::kLookahead}}) {
    if (chain.parent_weights == ParentWeights::kUniform)
      all.push_back([=] { return make_imh<R>(kModel, n, 2, chain, c); });
    all.push_back([=] { return make_auxiliary<R>(kModel, n, 2, chain, c); });
  }
  return all;
}

TEST(Checkpoint, ResumesEveryFilterBitByBit) {
  for (const OnCollapse c : {OnCollapse::kKeep, OnCollapse::kReset}) {
    std::size_t number = 0;
    for (const Make& make : all_filters<double>(c)) EXPECT_EQ(broken_promise(make), "") << "filter " << number++;
    for (const Make& make : all_filters<float>(c)) EXPECT_EQ(broken_promise(make), "") << "float filter " << number++;
    EXPECT_EQ(broken_promise([=] { return make_ekf(kModel, kParticles, c); }), "");
    EXPECT_EQ(broken_promise([=] { return make_ukf(kModel, kParticles, c); }), "");
  }
}

/// A filter that forgets to keep what it has.
class Forgetful final : public Filter {
 public:
  StepReport predict(Step t) override { return filter_->predict(t); }
  StepReport update(Step t, Rows<double> rows) override { return filter_->update(t, rows); }
  void select(Step t, StepReport& report) override { filter_->select(t, report); }
  WeightedSet weighted() const override { return filter_->weighted(); }
  void keep(Archive&) override {}

 private:
  std::unique_ptr<Filter> filter_ = make_sisr(kModel, kParticles, 2, {}, OnCollapse::kKeep);
};

TEST(Checkpoint, TheLawCatchesAFilterThatForgets) {
  EXPECT_EQ(broken_promise([] { return std::make_unique<Forgetful>(); }),
            "broken off after 1 steps: other estimates in row 0");
}

TEST(Checkpoint, IsOfOneSize) {
  std::string bytes;
  Archive out =
      Archive::to([&](const void* data, std::size_t count) { bytes.append(static_cast<const char*>(data), count); });
  make_sisr(kModel, 20, 1)->keep(out);
  std::size_t at = 0;
  Archive in = Archive::from(
      [&](void* data, std::size_t count) {
        std::copy_n(bytes.data() + at, count, static_cast<char*>(data));
        at += count;
      },
      bytes.size());
  EXPECT_THROW(make_sisr(kModel, 21, 1)->keep(in), ArchiveMismatch);
}

}  // namespace
}  // namespace mote
