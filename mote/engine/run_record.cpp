#include "mote/engine/run_record.hpp"

#include <algorithm>
#include <cmath>

namespace mote {
namespace {

/// Mean of the values that are numbers; NaN when there is none.
double mean_of(const std::vector<double>& values) {
  double sum = 0;
  std::size_t count = 0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return count == 0 ? kNaN : sum / static_cast<double>(count);
}

/// The estimated rows whose time has a true state.
template <class Visit>
void for_scored(const RunRecord& record, const Truth& truth, Visit&& visit) {
  for (const EstimateRow& row : record.rows) {
    const auto found = truth.states.find(row.t);
    if (found != truth.states.end()) visit(row, found->second);
  }
}

double rmse_of(const RunRecord& record, const Truth& truth, std::size_t d) {
  std::vector<double> squares;
  for_scored(record, truth, [&](const EstimateRow& row, const std::vector<double>& x) {
    const double e = row.states[d].mean - x[d];
    squares.push_back(std::pow(record.states[d].angle ? numbers::wrap(e) : e, 2));
  });
  return std::sqrt(mean_of(squares));
}

std::optional<std::size_t> find_state(const RunRecord& record, std::string_view name) {
  for (std::size_t d = 0; d < record.states.size(); ++d)
    if (record.states[d].name == name) return d;
  return std::nullopt;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// What it takes that each of P chains, taken for a processor, has all N parents.
Traffic shared_parents(const RunRecord& record) {
  const Plan& plan = record.plan;
  const std::size_t number = plan.precision == Precision::kFloat ? sizeof(float) : sizeof(double);
  const auto share = static_cast<double>(plan.particles) / static_cast<double>(plan.chain.chains);
  return all_gathered(plan.chain.chains, share * static_cast<double>(record.states.size() * number));
}

std::optional<PositionError> position_error(const RunRecord& record, const Truth& truth) {
  const auto ix = find_state(record, "x");
  const auto iy = find_state(record, "y");
  if (!ix || !iy || !truth.known[*ix] || !truth.known[*iy]) return std::nullopt;
  std::vector<double> distances;
  std::vector<double> squares;
  for_scored(record, truth, [&](const EstimateRow& row, const std::vector<double>& x) {
    const double distance = std::hypot(row.states[*ix].mean - x[*ix], row.states[*iy].mean - x[*iy]);
    if (std::isnan(distance)) return;
    distances.push_back(distance);
    squares.push_back(distance * distance);
  });
  if (distances.empty()) return std::nullopt;
  return PositionError{mean_of(distances), median(distances), std::sqrt(mean_of(squares))};
}

}  // namespace

Summary summarise(const RunRecord& record, const Truth* truth) {
  Summary summary{};
  std::vector<double> ess;
  std::vector<double> acceptance;
  std::vector<double> burn_in;
  Traffic traffic;
  for (const EstimateRow& row : record.rows) {
    summary.log_evidence += row.report.log_evidence;
    summary.collapses += row.report.collapsed ? 1 : 0;
    traffic += row.report.traffic;
    ess.push_back(row.report.ess);
    acceptance.push_back(row.report.acceptance);
    if (!std::isnan(row.report.acceptance)) burn_in.push_back(static_cast<double>(row.report.burn_in));
  }
  summary.mean_ess = mean_of(ess);
  const auto steps = static_cast<double>(record.rows.size());
  if (steps > 0) summary.traffic_per_step = {traffic.messages / steps, traffic.bytes / steps};
  const FilterKind filter = record.plan.filter;
  if (filter == FilterKind::kImh || filter == FilterKind::kAuxiliary) summary.traffic_per_step = shared_parents(record);
  summary.acceptance = mean_of(acceptance);
  summary.mean_burn_in = mean_of(burn_in);
  const double particle_steps =
      static_cast<double>(record.plan.particles) * static_cast<double>(record.predicted_steps);
  summary.ns_per_particle_step = particle_steps > 0 ? 1e9 * record.step_seconds / particle_steps : kNaN;
  if (truth == nullptr) return summary;
  for (std::size_t d = 0; d < record.states.size(); ++d)
    summary.rmse.push_back(truth->known[d] ? rmse_of(record, *truth, d) : kNaN);
  summary.position_error = position_error(record, *truth);
  return summary;
}

}  // namespace mote
