#include "mote/app/reproduce/runs.hpp"

#include <algorithm>

#include "mote/analog/spice.hpp"
#include "mote/app/analog/mixed_run.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/recording_file.hpp"
#include "mote/app/reproduce/faults.hpp"

namespace mote::reproduce {

Runs::Runs(Item item) : item_(std::move(item)) {
  const Source& from = item_.recording;
  header_ = from.simulated() ? frame_header(from.columns) : read_table(from.observations).header;
  source_ = model_with(from.settings, from.where);
  states_ = source_->states();
  for (const Run& run : item_.runs) benches_.emplace(run.name, bench_for(run));
}

std::unique_ptr<CatalogueModel> Runs::model_with(const std::vector<std::string>& settings,
                                                 const std::string& where) const {
  return as_bad_data([&] { return find_model(item_.recording.model, where).make(Settings(where, settings), header_); });
}

Runs::Bench Runs::bench_for(const Run& run) const {
  Bench bench;
  bench.job.model_name = item_.recording.model;
  bench.job.model = model_with(merged(item_.recording.settings, run.settings), run.where);
  if (run.circuit) {
    bench.circuit = as_bad_data([&] { return std::make_shared<CircuitBench>(run, bench.job); });
    return bench;
  }
  if (run.analog) {
    as_bad_data([&] {
      bench.analog = arguments_from(run.where, mixed_run_options(), run.options);
      return bench.plan = plan_from(*bench.analog);
    });
    return bench;
  }
  as_bad_data([&] {
    bench.plan = plan_from(arguments_from(run.where, plan_options(), run.options));
    return bench.job.model->filter(bench.plan, run.where);  // refuses what the model does not have
  });
  return bench;
}

std::optional<std::size_t> Runs::place_of(const std::string& state) const {
  for (std::size_t d = 0; d < states_.size(); ++d)
    if (states_[d].name == state) return d;
  return std::nullopt;
}

std::string Runs::missing() const {
  const bool analog = std::any_of(item_.runs.begin(), item_.runs.end(), [](const Run& run) { return run.analog; });
  return analog ? analog::Spice::missing() : "";
}

const Scene& Runs::scene(std::uint64_t offset) {
  if (!item_.recording.simulated()) offset = 0;
  const auto [found, fresh] = scenes_.try_emplace(offset);
  if (!fresh) return found->second;
  Scene& scene = found->second;
  const Source& from = item_.recording;
  if (!from.simulated()) {
    scene.recording = recording_from(read_table(from.observations), source_->columns(), from.model);
    if (!from.truth.empty()) scene.truth = truth_from(read_table(from.truth), states_);
    return scene;
  }
  return scene = simulated_scene(*source_, from.steps, from.seed + offset);
}

const RunRecord& Runs::record(const std::string& run, std::uint64_t recording_offset, std::uint64_t seed_offset) {
  refuse_when_stopped();
  const auto [found, fresh] = records_.try_emplace({run, recording_offset, seed_offset});
  if (!fresh && !found->second.rows.empty()) return found->second;
  Bench& bench = benches_.at(run);
  bench.job.recording = scene(recording_offset).recording;
  if (bench.circuit) return found->second = bench.circuit->record(bench.job.recording, seed_offset);
  Plan plan = bench.plan;
  plan.seed += seed_offset;
  if (bench.analog) return found->second = mixed_record(bench, plan);
  return found->second = run_job(bench.job, plan, request_for(bench.job, {}, item_.file), item_.file);
}

RunRecord Runs::mixed_record(Bench& bench, const Plan& plan) const {
  return as_bad_data([&] {
    if (!bench.design) bench.design = design_from(*bench.analog, *bench.job.model);
    const auto filter = mixed_filter(*bench.job.model, plan, *bench.design, bench.analog->where());
    return run_filter(*filter, bench.job, plan, request_for(bench.job, {}, item_.file));
  });
}

RunRecord Runs::record(const Plan& plan, std::uint64_t recording_offset) {
  refuse_when_stopped();
  Job job;
  job.model_name = item_.recording.model;
  job.model = model_with(item_.recording.settings, item_.recording.where);
  job.recording = scene(recording_offset).recording;
  return run_job(job, plan, request_for(job, {}, item_.file), item_.file);
}

}  // namespace mote::reproduce
