#include "mote/app/commands/plan_options.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

Arguments given(const std::vector<std::string>& words) { return arguments_from("test", plan_options(), words); }

Plan plan(const std::vector<std::string>& words) { return plan_from(given(words)); }

TEST(Plan, IsThePapersFilterByDefault) {
  const Plan p = plan({});
  EXPECT_EQ(p.filter, FilterKind::kSisr);
  EXPECT_EQ(p.particles, 1000U);
  EXPECT_EQ(p.seed, 1U);
  EXPECT_EQ(p.precision, Precision::kDouble);
  EXPECT_EQ(p.selection.scheme->name, "systematic");
  EXPECT_EQ(p.selection.ess_threshold, 1);
  EXPECT_EQ(p.chain.draws, 0U) << "0 stands for N";
  EXPECT_EQ(p.chain.burn_in, 0U);
  EXPECT_EQ(p.chain.chains, 1U);
  EXPECT_EQ(p.chain.parents, Parents::kIid);
  EXPECT_EQ(p.chain.start, ChainStart::kFirst);
  EXPECT_EQ(p.on_collapse, OnCollapse::kStop);
  EXPECT_EQ(p.groups.groups, 1U);
  EXPECT_EQ(p.groups.exchange, Exchange::kNone);
}

TEST(Plan, ImprovedIsShortForThreeOptionsThatMayBeOverruled) {
  const Plan p = plan({"--filter", "imh", "--improved"});
  EXPECT_EQ(p.chain.chains, 8U);
  EXPECT_EQ(p.chain.parents, Parents::kPermuted);
  EXPECT_EQ(p.chain.start, ChainStart::kWeighted);
  EXPECT_EQ(plan({"--filter", "imh", "--improved", "--chains", "2"}).chain.chains, 2U);
}

TEST(Plan, TakesEveryWordOfEveryChoice) {
  for (const std::string filter : {"sisr", "imh", "auxiliary", "distributed", "sqmc", "ekf", "ukf"})
    EXPECT_EQ(name_of(plan({"--filter", filter}).filter), filter);
  for (const Scheme& scheme : schemes())
    EXPECT_EQ(plan({"--resampler", std::string(scheme.name)}).selection.scheme->name, scheme.name);
  EXPECT_EQ(plan({"--exchange", "replace", "--filter", "distributed"}).groups.exchange, Exchange::kReplace);
  const std::vector<std::string> topologies{"ring", "bidirectional", "torus", "hypercube"};
  for (std::size_t i = 0; i < topologies.size(); ++i)
    EXPECT_EQ(plan({"--topology", topologies[i]}).groups.topology, static_cast<Topology>(i));
  EXPECT_EQ(plan({"--group-resampling", "rpa"}).groups.resampling, GroupResampling::kProportional);
  EXPECT_EQ(plan({"--group-resampling", "rna"}).groups.resampling, GroupResampling::kNonProportional);
  EXPECT_EQ(plan({"--group-resampling", "chain"}).groups.resampling, GroupResampling::kChain);
  EXPECT_EQ(plan({"--exchange-every", "4"}).groups.exchange_every, 4U);
  EXPECT_EQ(plan({"--exchange-when", "0.5"}).groups.exchange_when, 0.5);
  EXPECT_EQ(plan({"--precision", "float"}).precision, Precision::kFloat);
  EXPECT_EQ(plan({"--on-collapse", "reset"}).on_collapse, OnCollapse::kReset);
  EXPECT_FALSE(plan({"--filter", "imh", "--burn-in", "auto"}).chain.burn_in);
  EXPECT_EQ(plan({"-n7"}).particles, 7U);
  EXPECT_EQ(plan({"--seed=9223372036854775807"}).seed, 9223372036854775807U);
}

TEST(Plan, RefusesLeftoverWords) {
  EXPECT_THROW(plan({"--particlez", "3"}), Refusal);
  EXPECT_THROW(plan({"word"}), Refusal);
  EXPECT_THROW(plan({"-n", ""}), Refusal);
  EXPECT_THROW(plan({"--improved=no", "--filter", "imh"}), Refusal);
}

TEST(NotesOnUnread, TellEveryOptionThatHasNoSay) {
  const auto notes = [](const std::vector<std::string>& words) {
    const Arguments arguments = given(words);
    return notes_on_unread(arguments, plan_from(arguments)).size();
  };
  EXPECT_EQ(notes({}), 0U);
  EXPECT_EQ(notes({"--resampler", "alias", "--ess-threshold", "0.5"}), 0U);
  EXPECT_EQ(notes({"--chains", "2", "--burn-in", "3", "--groups", "2"}), 3U);
  EXPECT_EQ(notes({"--filter", "imh", "--chains", "2", "--burn-in", "3"}), 0U);
  EXPECT_EQ(notes({"--filter", "imh", "--resampler", "alias", "--ess-threshold", "0.5"}), 2U);
  EXPECT_EQ(notes({"--filter", "distributed", "--groups", "4", "--exchange", "swap", "--exchange-count", "2"}), 0U);
  EXPECT_EQ(notes({"--filter", "distributed", "--groups", "4", "--topology", "torus", "--exchange-every", "2"}), 2U);
  EXPECT_EQ(notes({"--filter", "distributed", "--group-resampling", "rpa", "--exchange-when", "0.5"}), 1U);
  EXPECT_EQ(notes({"--filter", "distributed", "--group-resampling", "rna", "--exchange-count", "2"}), 0U);
  EXPECT_EQ(notes({"--filter", "distributed", "--group-resampling", "rna", "--exchange", "swap"}), 1U);
  EXPECT_EQ(notes({"--filter", "sqmc", "--resampler", "alias", "--ess-threshold", "0.5", "--chains", "2"}), 3U);
  EXPECT_EQ(notes({"--filter", "ekf", "--resampler", "alias", "--seed", "2", "--precision", "float"}), 3U);
  EXPECT_EQ(notes({"--filter", "ukf", "--proposal", "prior", "-n", "50", "--on-collapse", "keep"}), 1U);
}

}  // namespace
}  // namespace mote
