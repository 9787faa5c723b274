#include "mote/app/reproduce/designs.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "mote/app/reproduce/answers.hpp"

namespace mote::reproduce {
namespace {

double answer(const DesignReport& report, const Comparison& c) {
  return answer_at(design_json(report), c, "mote design optimise", "cases/A/time");
}

}  // namespace

Designs::Designs(const Item& item) {
  for (const Run& run : item.runs) {
    std::vector<std::string> words = *item.design;
    words.insert(words.end(), run.options.begin(), run.options.end());
    reports_.emplace_back(run.name,
                          design_report(design_request_from(arguments_from(run.where, design_options(), words))));
  }
  for (const Comparison& c : item.comparisons) answer(reports_.front().second, c);  // refuses wrong keys
}

double Designs::figure(const Comparison& c, std::size_t side) const {
  const auto named = [&](const auto& entry) { return entry.first == c.runs[side]; };
  return answer(std::find_if(reports_.begin(), reports_.end(), named)->second, c);
}

std::vector<DesignCurve> Designs::curves(const Figure& figure) const {
  std::vector<DesignCurve> all;
  const bool pairs = figure.quantity == kDesignFigures[0];
  for (const auto& [name, report] : reports_) {
    if (!figure.runs.empty() && std::find(figure.runs.begin(), figure.runs.end(), name) == figure.runs.end()) continue;
    const design::Demand& d = report.request.demand;
    const double n = d.proposals(1);
    DesignCurve curve{name};
    for (int r = 1; r <= figure.repeats; ++r) {
      const auto count = static_cast<std::size_t>(r);
      curve.blocks.push_back(r);
      curve.exact.push_back(design::makespan(design::line_of(d, pairs ? count : 1, count, 1)));
      curve.law.push_back(pairs ? paired_time(n, r, d.times, {d.times.propose, d.times.weigh})
                                : single_chain_time(n, d.times, 1, r));
    }
    all.push_back(std::move(curve));
  }
  return all;
}

}  // namespace mote::reproduce
