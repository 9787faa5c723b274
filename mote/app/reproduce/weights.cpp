#include "mote/app/reproduce/weights.hpp"

#include "mote/app/commands/plan_options.hpp"
#include "mote/app/compare/statistics.hpp"
#include "mote/app/reproduce/faults.hpp"

namespace mote::reproduce {
namespace {

/// Resamplings of one weight vector.
constexpr std::size_t kResamplings = 200;

}  // namespace

Weights::Weights(const Item& item) : source_(*item.weights) {
  for (const Run& run : item.runs) {
    const Plan plan = as_bad_data([&] { return plan_from(arguments_from(run.where, plan_options(), run.options)); });
    benches_.push_back({run.name, *plan.selection.scheme});
  }
}

/// All runs on one weight vector, so that their times see the same machine.
const std::vector<Resampled>& Weights::resamplings(double ess, std::uint64_t repeat) {
  const auto [found, fresh] = resamplings_.try_emplace({ess, repeat});
  if (!fresh) return found->second;
  const WeightedValues set = weighted_values(source_.particles, ess, source_.seed + repeat);
  for (const Bench& bench : benches_)
    found->second.push_back(resampled(bench.scheme, set, kResamplings, source_.seed + repeat));
  return found->second;
}

double Weights::figure(const Comparison& c, std::uint64_t repeat, std::size_t side) {
  refuse_when_stopped();
  std::size_t place = 0;
  while (benches_[place].run != c.runs[side]) ++place;
  const Resampled& figure = resamplings(c.ess, repeat)[place];
  if (c.kind == Comparison::Kind::kResampleError) return figure.error;
  return c.kind == Comparison::Kind::kResampleTime ? figure.ns : figure.error * figure.ns;
}

std::vector<Tradeoff> Weights::tradeoffs() const {
  std::vector<Tradeoff> all;
  for (const double ess : source_.ess)
    for (std::size_t place = 0; place < benches_.size(); ++place) {
      std::vector<double> errors;
      std::vector<double> times;
      for (const auto& [level, runs] : resamplings_)
        if (level.first == ess) errors.push_back(runs[place].error), times.push_back(runs[place].ns);
      if (errors.empty()) continue;
      all.push_back({benches_[place].run, ess, compare::mean(errors), compare::median(times)});
    }
  return all;
}

}  // namespace mote::reproduce
