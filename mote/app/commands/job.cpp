#include "mote/app/commands/job.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mote/app/commands/memory.hpp"
#include "mote/app/files/recording_file.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"
#include "mote/report/run_page.hpp"

namespace mote {
namespace {

std::string note_of_unused(const Table& table, const std::vector<std::string>& read) {
  const auto unused = unused_columns(table, read);
  return unused.empty()
             ? ""
             : fmt::format("{}: note: nothing reads the column{} {}.", table.path, unused.size() > 1 ? "s" : "",
                           in_quotes(fmt::format("{}", fmt::join(unused, ","))));
}

}  // namespace

Job load_job(const std::string& model, const std::string& data_path, const std::string& truth_path,
             const std::vector<std::string>& settings, const std::string& where) {
  Job job;
  job.model_name = model;
  job.data_path = data_path;
  const CatalogueEntry& entry = find_model(model, where);
  const Settings given(where, settings);
  const Table table = read_table(data_path);
  job.model = entry.make(given, table.header);
  std::vector<std::string> names;
  for (const Column& column : job.model->columns()) names.push_back(column.name);
  job.recording = recording_from(table, job.model->columns(), model);
  if (auto note = note_of_unused(table, names); !note.empty()) job.notes.push_back(std::move(note));
  if (truth_path.empty()) return job;
  const Table truth = read_table(truth_path);
  names.clear();
  for (const Quantity& state : job.model->states()) names.push_back(state.name);
  job.truth = truth_from(truth, job.model->states());
  if (std::none_of(job.recording.steps.begin(), job.recording.steps.end(),
                   [&](const ObservedStep& step) { return job.truth->states.contains(step.t); }))
    job.notes.push_back(truth_path + ": note: no time t of the truth is in the data, so nothing is scored.");
  if (auto note = note_of_unused(truth, names); !note.empty()) job.notes.push_back(std::move(note));
  return job;
}

RunRequest request_for(const Job& job, const std::vector<std::string>& estimates, const std::string& where) {
  RunRequest request;
  request.where = where;
  request.states = job.model->states();
  request.sources = job.model->sources();
  for (std::string text : estimates) {
    std::erase(text, ' ');
    for (const Estimand& other : request.estimands)
      if (other.label == text)
        throw Refusal(ExitCode::kWrongUse,
                      {where, "--estimate", "every function once", text + " twice", "Pass it once."});
    request.estimands.push_back(parse_estimand(text, request.sources, where));
  }
  return request;
}

void check_memory(const Plan& plan, const Job& job, const std::string& where, const std::string& option) {
  const double need = bytes_needed(plan, job.model->states().size());
  const double have = available_memory();
  if (need <= have) return;
  throw Refusal(
      ExitCode::kWrongUse,
      {where, option, fmt::format("particles that fit into the {:.1f} GB of memory there are", have / 1e9),
       fmt::format("{}, which need {:.1f} GB", plan.particles, need / 1e9), fmt::format("Pass fewer {}.", option)});
}

RunRecord run_job(const Job& job, const Plan& plan, const RunRequest& request, const std::string& where) {
  check_memory(plan, job, where);
  return run_filter(*job.model->filter(plan, where), job, plan, request);
}

RunRecord run_filter(Filter& filter, const Job& job, const Plan& plan, const RunRequest& request) {
  RunRecord record = run(filter, plan, job.recording, request);
  record.model = job.model_name;
  record.engine = name_of(engine_of(plan));
  return record;
}

std::string report_for(const Job& job, const RunRecord& record, const Summary& summary,
                       const std::vector<report::Fact>& facts) {
  report::Page page =
      report::run_page(record, summary, job.recording, job.truth ? &*job.truth : nullptr, job.data_path, job.command);
  page.facts.insert(page.facts.end(), facts.begin(), facts.end());
  return report::html(page);
}

}  // namespace mote
