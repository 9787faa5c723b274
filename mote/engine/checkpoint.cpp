#include "mote/engine/checkpoint.hpp"

namespace mote {
namespace {

void keep(Archive& archive, StepReport& report) {
  std::uint64_t burn_in = report.burn_in;
  archive(report.log_evidence, report.ess, report.acceptance, burn_in, report.selected, report.collapsed,
          report.traffic.messages, report.traffic.bytes);
  report.burn_in = static_cast<std::size_t>(burn_in);
}

/// A row; one that is read has as many states and functions as the run.
void keep(Archive& archive, EstimateRow& row) {
  archive(row.t);
  for (Moments& state : row.states) archive(state.mean, state.sd);
  for (double& value : row.functions) archive(value);
  keep(archive, row.report);
}

}  // namespace

void RunState::keep(Archive& archive) {
  std::uint64_t rows = record.rows.size();
  archive(t, record.step_seconds, rows);
  if (archive.reads()) {
    if (rows > archive.left()) throw ArchiveMismatch("it ends too early");
    const EstimateRow blank{
        0, std::vector<Moments>(record.states.size()), std::vector<double>(record.function_labels.size()), {}};
    record.rows.assign(static_cast<std::size_t>(rows), blank);
  }
  for (EstimateRow& row : record.rows) mote::keep(archive, row);
}

}  // namespace mote
