// Fuzzes whole runs: any recording that the reader takes is filtered to numbers, or refused as collapsed.
// The first byte chooses model and filter, the rest is the CSV text.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <nlohmann/json.hpp>

#include "mote/app/commands/job.hpp"
#include "mote/app/files/recording_file.hpp"
#include "mote/app/files/run_files.hpp"
#include "mote/base/refusal.hpp"

namespace {

constexpr mote::Step kLast = 100;  // long gaps and recordings are slow, not interesting

void require(bool holds) {
  if (!holds) std::abort();
}

mote::Plan plan_of(std::uint8_t choice) {
  mote::Plan plan;
  plan.particles = 16;
  plan.filter = static_cast<mote::FilterKind>(choice % 4);
  plan.on_collapse = static_cast<mote::OnCollapse>(choice / 4 % 3);
  plan.chain.chains = 2;
  plan.groups.groups = 4;
  plan.groups.exchange = mote::Exchange::kSwap;
  return plan;
}

void judge(const mote::RunRecord& record, double particles) {
  for (const mote::EstimateRow& row : record.rows) {
    require(row.report.ess >= 0 && row.report.ess <= particles * (1 + 1e-9));
    require(!std::isnan(row.report.log_evidence));
    for (const mote::Moments& m : row.states) require(!std::isnan(m.mean) && !(m.sd < 0));
  }
}

void filter(std::uint8_t choice, const std::string& text) {
  const auto& models = mote::catalogue();
  const mote::CatalogueEntry& entry = models[choice / 12 % models.size()];
  if (entry.name == "linear-gaussian") return;  // needs a file
  const mote::Table table = mote::parse_table("fuzz.csv", text);
  mote::Job job;
  job.model_name = entry.name;
  job.model = entry.make(mote::Settings("fuzz", {}), table.header);
  job.recording = mote::recording_from(table, job.model->columns(), entry.name);
  if (job.recording.steps.size() > kLast || job.recording.steps.back().t > kLast) return;
  const mote::Plan plan = plan_of(choice);
  const mote::RunRecord record =
      mote::run_job(job, plan, mote::request_for(job, {"median(" + job.model->states()[0].name + ")"}, "fuzz"), "fuzz");
  judge(record, static_cast<double>(plan.particles));
  require(!mote::estimates_csv(record).empty());
  require(!mote::summary_json(record, mote::summarise(record, nullptr)).dump().empty());
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    filter(data[0], std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  } catch (const mote::Refusal&) {  // what bad input is meant to give, and a collapse
  }
  return 0;
}
