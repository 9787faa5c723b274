#include "mote/design/programs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mote/base/numbers.hpp"
#include "mote/design/geometric.hpp"

namespace mote::design {
namespace {

constexpr double kTie = 1e-7;

/// The variables: R_p, R_w, and S, the larger of 1 and R_w/R_p.
constexpr std::size_t kVariables = 3;

/// c R_p^p R_w^w S^s; nothing where c is 0.
Posynomial term(double coefficient, double p, double w, double s = 0) {
  if (coefficient == 0) return {};
  return {{coefficient, {p, w, s}}};
}

/// A case: its time, and limits that hold it; `never` where one of them cannot be met by any R.
struct Case {
  Posynomial time;
  std::vector<Posynomial> limits;
  bool never = false;

  void limit(const Posynomial& sum) {
    if (!sum.empty()) limits.push_back(sum);
  }
};

/// left <= right of monomials that may be 0.
void order(Case& c, const Posynomial& left, const Posynomial& right) {
  if (left.empty()) return;
  if (right.empty()) {
    c.never = true;
    return;
  }
  Monomial quotient = left.front();
  quotient.coefficient /= right.front().coefficient;
  for (std::size_t i = 0; i < kVariables; ++i) quotient.powers[i] -= right.front().powers[i];
  c.limits.push_back({quotient});
}

/// Times a particle, the inverses of rates.
struct Paces {
  Posynomial propose, weigh, chain;
};

void bound(Case& c, double n) {
  c.limit(term(1 / n, 1, 0));
  c.limit(term(1 / n, 0, 1));
}

Case case_of(Bottleneck which, const StageTimes& t, double n, Print print) {
  const Paces pace{term(t.propose, -1, 0), term(t.weigh, 0, -1), term(t.chain, 0, 0)};
  Case c;
  bound(c, n);
  const bool equations = print == Print::kEquations;
  switch (which) {
    case Bottleneck::kProposals:
      c.time = term(n * t.propose, -1, 0) + term(t.weigh, 1, -1) + term(t.chain, 0, 1);
      order(c, pace.weigh, pace.propose);
      order(c, pace.chain, pace.weigh);
      break;
    case Bottleneck::kWeights:
      order(c, pace.propose, pace.weigh);
      order(c, pace.chain, pace.weigh);
      c.time = term(n * t.weigh, 0, -1) + term(t.chain, 0, 1);
      if (print == Print::kCorrected) {
        c.time = c.time + term(t.propose, 0, 0, 1);
        c.limit(term(1, 0, 0, -1));
        c.limit(term(1, -1, 1, -1));
      } else {
        c.time = c.time + term(t.propose, -1, 1);
        c.limit(equations ? term(1, 1, -1) : term(1, -1, 1));  // (32); table I
      }
      break;
    case Bottleneck::kProposalsThenChain:
      if (equations) {  // (34), (35)
        c.time = term(n * t.propose, -1, 0) + term(t.weigh, 1, -1) + term(t.chain, 0, 1);
        order(c, pace.weigh, pace.propose);
        order(c, pace.chain, pace.weigh);
        break;
      }
      c.time = term(n * t.propose, -1, 0) + term(t.weigh, 0, 0) + term(t.chain, 1, 0);
      order(c, pace.chain, pace.propose);
      order(c, pace.weigh, pace.chain);
      break;
    case Bottleneck::kChain:
      c.time = term(t.propose + t.weigh + n * t.chain, 0, 0);
      order(c, pace.propose, pace.chain);
      order(c, pace.weigh, pace.chain);
      break;
  }
  return c;
}

/// What a case's programs are made of, for one number of chains.
struct Quantities {
  Posynomial time, blocks, energy;

  const Posynomial& of(Goal goal) const { return goal == Goal::kTime ? time : goal == Goal::kBlocks ? blocks : energy; }
};

Quantities quantities(const Demand& d, const Case& c, std::size_t chains) {
  const auto p = static_cast<double>(chains);
  const Posynomial idle = term(p * d.idle.propose, 1, 0) + term(p * d.idle.weigh, 0, 1) + term(p * d.idle.chain, 0, 0);
  const double work = d.energy.propose + d.energy.weigh + d.energy.chain;
  return {c.time, term(p * d.weights.propose, 1, 0) + term(p * d.weights.weigh, 0, 1) + term(p * d.weights.chain, 0, 0),
          term(p * d.proposals(chains) * work, 0, 0) + idle * c.time};
}

/// Adds sum <= most.
void hold(GeometricProgram& program, const Posynomial& sum, double most) {
  if (!sum.empty()) program.limits.push_back((1 / most) * sum);
}

GeometricProgram program_of(const Demand& d, const Case& c, const Quantities& q) {
  GeometricProgram program{kVariables, q.of(d.goal), c.limits};
  if (d.deadline) hold(program, q.time, *d.deadline);
  if (d.most_blocks) hold(program, q.blocks, *d.most_blocks);
  if (d.most_energy) hold(program, q.energy, *d.most_energy);
  return program;
}

/// Of all optima the one of least blocks, or where blocks are the goal of least time.
Optimum with_tie_broken(GeometricProgram program, const Quantities& q, Goal goal, const Optimum& optimum) {
  hold(program, q.of(goal), optimum.value * (1 + kTie / 10));
  program.objective = goal == Goal::kBlocks ? q.time : q.blocks;
  Optimum broken = solve(program);
  if (!broken.feasible || value_of(program.objective, broken.x) > value_of(program.objective, optimum.x))
    return optimum;
  broken.kkt_residual = optimum.kkt_residual;
  return broken;
}

/// -d log time / d log x_i, where S follows R_w/R_p above 1.
double elasticity(const Posynomial& time, const std::vector<double>& x, std::size_t i) {
  const bool follows = x[1] > x[0];
  double sum = 0;
  for (const Monomial& m : time) {
    const double power = m.powers[i] + (follows ? (i == 1 ? m.powers[2] : -m.powers[2]) : 0);
    sum += power * value_of({m}, x);
  }
  return -sum / value_of(time, x);
}

CaseAnswer answer(const Demand& d, Bottleneck which, std::size_t chains, Print print) {
  CaseAnswer found;
  const Case c = case_of(which, d.times, d.proposals(chains), print);
  if (c.never) return found;
  const Quantities q = quantities(d, c, chains);
  const GeometricProgram program = program_of(d, c, q);
  if (program.objective.empty()) return found;
  const Optimum first = solve(program);
  if (!first.feasible) return found;
  const Optimum best = with_tie_broken(program, q, d.goal, first);
  found.feasible = true;
  found.kkt_residual = best.kkt_residual;
  const double time = value_of(q.time, best.x);
  found.plant = {best.x[0], best.x[1], chains, time, value_of(q.blocks, best.x), value_of(q.energy, best.x)};
  found.proposer_elasticity = elasticity(q.time, best.x, 0);
  found.weigher_elasticity = elasticity(q.time, best.x, 1);
  return found;
}

/// Whether a is better than b by the goal; ties by blocks, then by time.
bool better(const CaseAnswer& a, const CaseAnswer& b, Goal goal) {
  if (a.feasible != b.feasible) return a.feasible;
  if (!a.feasible) return false;
  const auto ranked = [&](const Plant& p) {
    return std::array{goal == Goal::kTime ? p.time : goal == Goal::kEnergy ? p.energy : p.blocks, p.blocks, p.time};
  };
  const auto left = ranked(a.plant);
  const auto right = ranked(b.plant);
  for (std::size_t i = 0; i < left.size(); ++i)
    if (std::abs(left[i] - right[i]) > kTie * std::abs(right[i])) return left[i] < right[i];
  return false;
}

}  // namespace

double blocks_of(const Demand& d, double proposers, double weighers, double chains) {
  return chains * (d.weights.propose * proposers + d.weights.weigh * weighers + d.weights.chain);
}

double energy_of(const Demand& d, double proposers, double weighers, std::size_t chains, double time) {
  const auto p = static_cast<double>(chains);
  return p * d.proposals(chains) * (d.energy.propose + d.energy.weigh + d.energy.chain) +
         p * (d.idle.propose * proposers + d.idle.weigh * weighers + d.idle.chain) * time;
}

Answer optimise(const Demand& d, Print print) {
  Answer all;
  for (std::size_t chains = 1; chains <= d.most_chains; ++chains)
    for (std::size_t k = 0; k < all.cases.size(); ++k) {
      const CaseAnswer one = answer(d, static_cast<Bottleneck>(k), chains, print);
      if (better(one, all.cases[k], d.goal)) all.cases[k] = one;
    }
  for (std::size_t k = 0; k < all.cases.size(); ++k)
    if (all.cases[k].feasible && (!all.best || better(all.cases[k], all[*all.best], d.goal)))
      all.best = static_cast<Bottleneck>(k);
  return all;
}

}  // namespace mote::design
