#include "mote/app/files/run_files.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mote {
namespace {

bool has_chain(const RunRecord& record) {
  return record.plan.filter == FilterKind::kImh || record.plan.filter == FilterKind::kAuxiliary;
}

/// A column name as CSV wants it.
std::string field(const std::string& name) {
  return name.find_first_of("\",") == std::string::npos ? name : "\"" + name + "\"";
}

/// JSON has no infinities: null stands for "not a number".
nlohmann::json number(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr); }

nlohmann::json stages_json(const StageRecord& record) {
  nlohmann::json all = nlohmann::json::array();
  for (const StageUse& stage : record.stages) {
    nlohmann::json workers = nlohmann::json::array();
    for (const StageWorker& worker : stage.workers)
      workers.push_back({{"busy_seconds", worker.busy_seconds},
                         {"idle_seconds", record.seconds - worker.busy_seconds},
                         {"blocks", worker.blocks}});
    all.push_back({{"stage", stage.name},
                   {"workers", std::move(workers)},
                   {"mean_queue", stage.mean_queue},
                   {"largest_queue", stage.largest_queue}});
  }
  return all;
}

}  // namespace

std::string estimates_csv(const RunRecord& record) {
  std::string csv = "t";
  for (const Quantity& state : record.states) csv += "," + state.name + "_mean," + state.name + "_sd";
  csv += ",ess,log_evidence";
  if (has_chain(record)) csv += ",acceptance";
  for (const std::string& label : record.function_labels) csv += "," + field(label);
  csv += '\n';
  for (const EstimateRow& row : record.rows) {
    csv += std::to_string(row.t);
    for (const Moments& m : row.states) csv += "," + exact(m.mean) + "," + exact(m.sd);
    csv += "," + exact(row.report.ess) + "," + exact(row.report.log_evidence);
    if (has_chain(record)) csv += "," + exact(row.report.acceptance);
    for (const double value : row.functions) csv += "," + exact(value);
    csv += '\n';
  }
  return csv;
}

nlohmann::json summary_json(const RunRecord& record, const Summary& summary) {
  nlohmann::json json{{"model", record.model},
                      {"filter", name_of(record.plan.filter)},
                      {"engine", record.engine},
                      {"particles", record.plan.particles},
                      {"seed", record.plan.seed},
                      {"steps", record.rows.size()},
                      {"predicted_steps", record.predicted_steps},
                      {"log_evidence", number(summary.log_evidence)},
                      {"wall_seconds", record.wall_seconds},
                      {"ns_per_particle_step", number(summary.ns_per_particle_step)},
                      {"mean_ess", number(summary.mean_ess)},
                      {"collapses", summary.collapses}};
  if (has_chain(record)) {
    json["acceptance"] = number(summary.acceptance);
    json["mean_burn_in"] = number(summary.mean_burn_in);
  }
  if (record.stages) {
    json["threads"] = record.stages->threads;
    json["stage_seconds"] = record.stages->seconds;
    json["barrier_seconds"] = record.stages->barrier_seconds;
    json["stages"] = stages_json(*record.stages);
  }
  if (has_chain(record) || record.plan.filter == FilterKind::kDistributed) {
    json["messages_per_step"] = summary.traffic_per_step.messages;
    json["bytes_per_step"] = summary.traffic_per_step.bytes;
  }
  if (!summary.rmse.empty()) {
    json["rmse"] = nlohmann::json::object();
    for (std::size_t d = 0; d < summary.rmse.size(); ++d)
      if (std::isfinite(summary.rmse[d])) json["rmse"][record.states[d].name] = summary.rmse[d];
  }
  if (summary.position_error)
    json["position_error"] = {{"mean", summary.position_error->mean},
                              {"median", summary.position_error->median},
                              {"rmse", summary.position_error->rmse}};
  return json;
}

std::string particles_header(const std::vector<Quantity>& states) {
  std::string line = "t";
  for (const Quantity& state : states) line += "," + state.name;
  return line + ",weight\n";
}

void write_particles(Output& out, Step t, const WeightedSet& set) {
  set.visit([&](const auto& x) {
    fmt::memory_buffer line;
    for (std::size_t i = 0; i < set.size(); ++i) {
      line.clear();
      fmt::format_to(std::back_inserter(line), "{}", t);
      for (std::size_t d = 0; d < x.dimensions(); ++d)
        fmt::format_to(std::back_inserter(line), ",{}", x.component(d)[i]);
      fmt::format_to(std::back_inserter(line), ",{}\n", set.weights[i] / set.total);
      out.write({line.data(), line.size()});
    }
  });
}

}  // namespace mote
