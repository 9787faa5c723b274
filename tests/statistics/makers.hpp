#pragma once
/// Every filter there is, by name, for models with an optimal proposal.

#include "tests/statistics/support.hpp"

namespace mote::statistics {

inline GroupOptions groups_of(std::size_t groups, Exchange exchange, bool carry = true) {
  return {.groups = groups, .exchange = exchange, .exchange_count = 2, .carry_group_weights = carry};
}
inline GroupOptions groups_of(std::size_t groups, GroupResampling resampling) {
  return {.groups = groups, .resampling = resampling, .exchange_count = 2};
}
/// The same on another topology than the ring.
inline GroupOptions on(Topology topology, GroupOptions groups) {
  groups.topology = topology;
  return groups;
}

/// The eight chains of `--improved`.
inline ChainOptions improved() { return {.chains = 8, .parents = Parents::kPermuted, .start = ChainStart::kWeighted}; }

/// Filters whose evidence is unbiased by theory. `every_scheme`: each scheme but metropolis, which states a bias, else
/// the default.
template <class Optimal, Model M>
std::vector<Maker> unbiased_filters(const M& model, bool every_scheme) {
  std::vector<Maker> all;
  const auto sisr = [&](const std::string& name, const SelectionOptions& options) {
    all.push_back(
        {"sisr, " + name, [=](std::size_t n, std::uint64_t seed) { return make_sisr(model, n, seed, options); }});
  };
  for (const Scheme& scheme : schemes()) {
    if (scheme.name == "metropolis" || !(every_scheme || scheme.name == "systematic")) continue;
    sisr(std::string(scheme.name), {.scheme = &scheme});
    sisr(std::string(scheme.name) + ", ess 0.5", {.scheme = &scheme, .ess_threshold = 0.5});
  }
  sisr("never resampled", {.ess_threshold = 0});
  all.back().bias = 0.1;  // few effective particles are left after ten steps
  sisr("exponent 0.5", {.exponent = 0.5});
  sisr("exponent 0.5, ess 0.5", {.ess_threshold = 0.5, .exponent = 0.5});
  all.push_back({"sisr, float", [=](std::size_t n, std::uint64_t seed) { return make_sisr<float>(model, n, seed); }});
  all.push_back(
      {"sisr, optimal", [=](std::size_t n, std::uint64_t seed) { return make_sisr<double, Optimal>(model, n, seed); }});
  all.push_back({"sisr, optimal, float",
                 [=](std::size_t n, std::uint64_t seed) { return make_sisr<float, Optimal>(model, n, seed); }});
  const auto distributed = [&](const std::string& name, const GroupOptions& groups,
                               const SelectionOptions& options = {}) {
    all.push_back({"distributed, " + name, [=](std::size_t n, std::uint64_t seed) {
                     return make_distributed(model, n, seed, groups, options);
                   }});
  };
  distributed("local", groups_of(8, Exchange::kNone));
  distributed("local, ess 0.5", groups_of(8, Exchange::kNone), {.ess_threshold = 0.5});
  distributed("swap", groups_of(8, Exchange::kSwap));
  distributed("swap, ess 0.5", groups_of(8, Exchange::kSwap), {.ess_threshold = 0.5});
  distributed("append", groups_of(8, Exchange::kAppend));
  distributed("append, exponent 0.5", groups_of(8, Exchange::kAppend), {.exponent = 0.5});
  distributed("swap, both ways", on(Topology::kBidirectional, groups_of(8, Exchange::kSwap)));
  distributed("append, torus", on(Topology::kTorus, groups_of(8, Exchange::kAppend)));
  distributed("swap, hypercube", on(Topology::kHypercube, groups_of(8, Exchange::kSwap)));
  GroupOptions now_and_then = groups_of(8, Exchange::kAppend);
  now_and_then.exchange_every = 3;
  distributed("append, every third step", now_and_then);
  GroupOptions when_needed = groups_of(8, Exchange::kSwap);
  when_needed.exchange_when = 0.7;
  distributed("swap, when weights diverge", when_needed);
  distributed("rna", groups_of(8, GroupResampling::kNonProportional));
  distributed("rna, hypercube", on(Topology::kHypercube, groups_of(8, GroupResampling::kNonProportional)));
  distributed("rpa", groups_of(8, GroupResampling::kProportional));
  distributed("rpa, exponent 0.5, ess 0.5", groups_of(8, GroupResampling::kProportional),
              {.ess_threshold = 0.5, .exponent = 0.5});
  distributed("global", groups_of(8, GroupResampling::kGlobal));
  all.push_back({"sqmc", [=](std::size_t n, std::uint64_t seed) { return make_sqmc(model, n, seed); }});
  all.push_back({"sqmc, float", [=](std::size_t n, std::uint64_t seed) { return make_sqmc<float>(model, n, seed); }});
  all.push_back(
      {"sqmc, optimal", [=](std::size_t n, std::uint64_t seed) { return make_sqmc<double, Optimal>(model, n, seed); }});
  const ChainOptions start{.start = ChainStart::kWeighted};
  const ChainOptions lookahead{.start = ChainStart::kWeighted, .parent_weights = ParentWeights::kLookahead};
  all.push_back(
      {"auxiliary", [=](std::size_t n, std::uint64_t seed) { return make_auxiliary(model, n, seed, start); }});
  all.push_back({"auxiliary, look-ahead",
                 [=](std::size_t n, std::uint64_t seed) { return make_auxiliary(model, n, seed, lookahead); }});
  all.push_back({"auxiliary, optimal", [=](std::size_t n, std::uint64_t seed) {
                   return make_auxiliary<double, Optimal>(model, n, seed, start);
                 }});
  all.push_back({"auxiliary, optimal, look-ahead, float", [=](std::size_t n, std::uint64_t seed) {
                   return make_auxiliary<float, Optimal>(model, n, seed, lookahead);
                 }});
  all.push_back({"imh, 8 chains, weighted start", [=](std::size_t n, std::uint64_t seed) {
                   return make_imh(model, n, seed, {.chains = 8, .start = ChainStart::kWeighted});
                 }});
  all.push_back({"imh, Q = 2 N, weighted start", [=](std::size_t n, std::uint64_t seed) {
                   return make_imh(model, n, seed, {.draws = 2 * n, .chains = 4, .start = ChainStart::kWeighted});
                 }});
  return all;
}

/// Filters that are consistent, with biases of order 1/N (of order chains/N where unburnt chains start at their first
/// proposal).
template <class Optimal, Model M>
std::vector<Maker> consistent_filters(const M& model) {
  std::vector<Maker> all;
  const auto imh = [&](const std::string& name, const ChainOptions& options) {
    all.push_back(
        {"imh, " + name, [=](std::size_t n, std::uint64_t seed) { return make_imh(model, n, seed, options); }});
  };
  imh("first", {});
  imh("8 chains, first", {.chains = 8});
  all.back().bias = 0.2;  // some 30 of the 1000 kept are states before the chains settled
  imh("8 chains, permuted, weighted start", improved());
  imh("burn-in N/10", {.burn_in = 100});
  imh("burn-in auto", {.burn_in = std::nullopt, .chains = 4});
  all.push_back(
      {"imh, float", [=](std::size_t n, std::uint64_t seed) { return make_imh<float>(model, n, seed, improved()); }});
  all.push_back({"auxiliary, first",
                 [=](std::size_t n, std::uint64_t seed) { return make_auxiliary<double, Optimal>(model, n, seed); }});
  const Scheme* metropolis = find_scheme("metropolis");
  all.push_back({"sisr, metropolis",
                 [=](std::size_t n, std::uint64_t seed) { return make_sisr(model, n, seed, {.scheme = metropolis}); }});
  all.push_back({"distributed, chain, append", [=](std::size_t n, std::uint64_t seed) {
                   GroupOptions groups = groups_of(8, Exchange::kAppend);
                   groups.resampling = GroupResampling::kChain;
                   return make_distributed(model, n, seed, groups);
                 }});
  for (Maker& maker : all) maker.bias = std::max(maker.bias, 0.02);
  return all;
}

}  // namespace mote::statistics
