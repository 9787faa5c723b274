#include "mote/design/laws.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace mote::design {
namespace {

std::string number_of(Bottleneck which) {
  switch (which) {
    case Bottleneck::kProposals:
      return "L5";
    case Bottleneck::kWeights:
      return "L6";
    case Bottleneck::kProposalsThenChain:
      return "L7";
    case Bottleneck::kChain:
      break;
  }
  return "L8";
}

struct Setting {
  Demand demand;
  std::size_t proposers, weighers, chains;
};

Setting some_setting(std::mt19937_64& random) {
  const auto decades = [&](double from, double to) {
    return std::pow(10, std::uniform_real_distribution<double>(from, to)(random));
  };
  Setting s;
  s.demand.times = {decades(-3, 3), decades(-3, 3), decades(-3, 3)};
  s.demand.kept = static_cast<std::size_t>(decades(1, 6));
  const auto q = static_cast<double>(s.demand.kept);
  s.demand.burn_in = random() % 2 == 0 ? 0 : static_cast<std::size_t>(decades(0, std::log10(q / 8)));
  const double most = std::log10(std::min(1000.0, s.demand.proposals(1)));
  s.proposers = static_cast<std::size_t>(decades(0, most));
  s.weighers = static_cast<std::size_t>(decades(0, most));
  s.chains = std::size_t{1} << random() % 4;
  return s;
}

LawErrors summed_up(const std::string& law, std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  LawErrors all{law, errors.size(), errors[errors.size() / 2], errors.front(), errors.back()};
  for (double& e : errors) e = std::abs(e);
  std::sort(errors.begin(), errors.end());
  all.usual = errors[errors.size() * 19 / 20];
  return all;
}

}  // namespace

std::vector<LawCheck> check_laws(const Demand& d, std::size_t proposers, std::size_t weighers, std::size_t chains) {
  const StageTimes& t = d.times;
  const StageLatencies latencies{t.propose, t.weigh};
  const auto rp = static_cast<double>(proposers);
  const auto rw = static_cast<double>(weighers);
  const double n = d.proposals(1);
  const std::size_t whole = line_of(d, 1, 1, 1).n;
  const auto exact = [&](std::size_t p, std::size_t w, std::size_t copies) {
    return makespan(line_of(d, p, w, copies));
  };
  std::vector<LawCheck> all{
      {"L1", sequential_time(n, t, latencies), exact(1, 1, 1)},
      {"L2", unbounded_time(n, t, latencies), exact(whole, whole, 1)},
      {"L3", paired_time(n, rp, t, latencies), exact(proposers, proposers, 1)},
      {number_of(bottleneck_of(t, rp, rw)), single_chain_time(n, t, rp, rw), exact(proposers, weighers, 1)}};
  if (chains > 1)
    all.push_back({"L4", single_chain_time(d.proposals(chains), t, rp, rw), exact(proposers, weighers, chains)});
  const auto q = static_cast<double>(d.kept);
  const double barrier = q * t.chain;
  const Line stages{d.kept, {t.propose, t.weigh, 0}, proposers, weighers};
  all.push_back({"L9", barrier_time(q, t, rp, rw, barrier), makespan(stages) + barrier});
  return all;
}

std::vector<LawErrors> survey_laws(std::size_t demands, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::map<std::string, std::vector<double>> errors;
  for (std::size_t k = 0; k < demands; ++k) {
    const Setting s = some_setting(random);
    for (const LawCheck& check : check_laws(s.demand, s.proposers, s.weighers, s.chains))
      errors[check.law].push_back(check.error());
  }
  std::vector<LawErrors> all;
  for (auto& [law, values] : errors) all.push_back(summed_up(law, std::move(values)));
  return all;
}

}  // namespace mote::design
