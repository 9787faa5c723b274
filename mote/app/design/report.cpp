#include "mote/app/design/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mote {
namespace {

using Json = nlohmann::json;
using namespace design;

constexpr const char* kNames[] = {"A", "B", "C", "D"};
constexpr const char* kMeanings[] = {"proposals, then weights", "weights", "proposals, then the chain", "the chain"};

double exact(const DesignRequest& request, std::size_t proposers, std::size_t weighers, std::size_t chains) {
  return schedule(line_of(request.demand, proposers, weighers, chains, request.queue, request.message)).makespan;
}

/// The fewest pairs whose exact time no number of pairs falls short of; more pairs are never slower.
std::size_t fewest_pairs(const Demand& d) {
  const std::size_t n = line_of(d, 1, 1, 1).n;
  const double quickest = makespan(line_of(d, n, n, 1));
  std::size_t low = 1;
  std::size_t high = n;
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (makespan(line_of(d, middle, middle, 1)) <= quickest * (1 + 1e-12)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

Json case_json(const CaseAnswer& found) {
  if (!found.feasible)
    return {{"feasible", false}, {"time", nullptr}, {"rp", nullptr}, {"rw", nullptr}, {"chains", nullptr}};
  const Plant& p = found.plant;
  return {{"feasible", true},
          {"time", p.time},
          {"rp", p.proposers},
          {"rw", p.weighers},
          {"chains", p.chains},
          {"blocks", p.blocks},
          {"energy", p.energy},
          {"kkt_residual", found.kkt_residual},
          {"elasticity_rp", found.proposer_elasticity},
          {"elasticity_rw", found.weigher_elasticity}};
}

std::vector<std::string> broken(const WholeAnswer& whole) {
  std::vector<std::string> limits;
  if (whole.breaks_deadline) limits.emplace_back("--deadline");
  if (whole.breaks_blocks) limits.emplace_back("--most-blocks");
  if (whole.breaks_energy) limits.emplace_back("--most-energy");
  return limits;
}

std::string whole_text(const DesignReport& report) {
  const WholePlant& p = report.whole.plant;
  std::string text = report.whole.feasible ? "Best whole numbers: "
                                           : fmt::format("Not feasible: nothing keeps {}. Nearest: ",
                                                         fmt::join(broken(report.whole), " and "));
  text += fmt::format("R_p {}, R_w {}, P {}: exact time {:.6g}, law {:.6g} ({:+.2f} %), blocks {:.6g}{}\n", p.proposers,
                      p.weighers, p.chains, p.exact_time, report.law_time, 100 * (report.law_time / p.exact_time - 1),
                      p.blocks, p.energy > 0 ? fmt::format(", energy {:.6g}", p.energy) : "");
  text += fmt::format("{} after {} schedules\n",
                      report.whole.proven ? "Proven: nothing better exists," : "Not proven: the search ended",
                      report.whole.schedules);
  for (const auto& [name, time] : {std::pair{"proposer", report.one_more_proposer},
                                   {"weigher", report.one_more_weigher},
                                   {"chain", report.one_more_chain}})
    text += fmt::format("One more {:<9}{:.6g}, saves {:.3g}\n", name, time, p.exact_time - time);
  return text;
}

}  // namespace

DesignReport design_report(const DesignRequest& request) {
  DesignReport report{request, optimise(request.demand, request.print), {}, 0, 1, 1, 0, 0, 0};
  report.pairs_by_rule = request.demand.times.chain > 0 ? best_pairs(request.demand.times) : 0;
  report.fewest_pairs = fewest_pairs(request.demand);
  report.whole = optimise_whole(request.demand, request.queue, request.message);
  const WholePlant& p = report.whole.plant;
  report.law_time =
      single_chain_time(static_cast<double>(line_of(request.demand, 1, 1, p.chains).n), request.demand.times,
                        static_cast<double>(p.proposers), static_cast<double>(p.weighers));
  report.laws = check_laws(request.demand, p.proposers, p.weighers, p.chains);
  report.one_more_proposer = exact(request, p.proposers + 1, p.weighers, p.chains);
  report.one_more_weigher = exact(request, p.proposers, p.weighers + 1, p.chains);
  report.one_more_chain = exact(request, p.proposers, p.weighers, p.chains + 1);
  return report;
}

Json design_json(const DesignReport& report) {
  Json cases = Json::object();
  for (std::size_t k = 0; k < 4; ++k) cases[kNames[k]] = case_json(report.answer.cases[k]);
  const WholePlant& p = report.whole.plant;
  const auto more = [&](double time) { return Json{{"exact_time", time}, {"saves", p.exact_time - time}}; };
  const auto& best = report.answer.best;
  Json laws = Json::object();
  for (const LawCheck& check : report.laws)
    laws[check.law] = {{"time", check.time}, {"exact_time", check.exact_time}, {"error", check.error()}};
  return {{"cases", cases},
          {"best", best ? Json(kNames[static_cast<std::size_t>(*best)]) : Json(nullptr)},
          {"integer",
           {{"feasible", report.whole.feasible},
            {"rp", p.proposers},
            {"rw", p.weighers},
            {"chains", p.chains},
            {"time", report.law_time},
            {"exact_time", p.exact_time},
            {"law_error", report.law_time / p.exact_time - 1},
            {"blocks", p.blocks},
            {"energy", p.energy},
            {"proven", report.whole.proven},
            {"schedules", report.whole.schedules},
            {"breaks", broken(report.whole)}}},
          {"laws", laws},
          {"pairs",
           {{"rule", report.pairs_by_rule > 0 ? Json(report.pairs_by_rule) : Json(nullptr)},
            {"fewest", report.fewest_pairs}}},
          {"one_more",
           {{"proposer", more(report.one_more_proposer)},
            {"weigher", more(report.one_more_weigher)},
            {"chain", more(report.one_more_chain)}}}};
}

std::string design_text(const DesignReport& report) {
  std::string text =
      fmt::format("{:<28}{:>12}{:>12}{:>12}{:>4}{:>12}{:>10}\n", "slowest", "time", "R_p", "R_w", "P", "blocks", "KKT");
  for (std::size_t k = 0; k < 4; ++k) {
    const CaseAnswer& found = report.answer.cases[k];
    const std::string name = fmt::format("{} {}", kNames[k], kMeanings[k]);
    const Plant& p = found.plant;
    text += found.feasible ? fmt::format("{:<28}{:>12.6g}{:>12.6g}{:>12.6g}{:>4}{:>12.6g}{:>10.1e}\n", name, p.time,
                                         p.proposers, p.weighers, p.chains, p.blocks, found.kkt_residual)
                           : fmt::format("{:<28}{:>12}\n", name, "infeasible");
  }
  if (report.answer.best)
    text += fmt::format("Best of real numbers: case {}\n", kNames[static_cast<std::size_t>(*report.answer.best)]);
  return text + whole_text(report);
}

}  // namespace mote
