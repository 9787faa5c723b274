#pragma once
// The report of one run.

#include <string>

#include "mote/engine/run_record.hpp"
#include "mote/report/page.hpp"

namespace mote::report {

/// A run as a page: every state with its 2-sd band, truth and direct observations; the track in the plane for models
/// with states x and y; other observations; ESS, acceptance, evidence and functions over time; the stages of a pipeline
/// at work; the figures; the command.
///
/// `truth` may be nullptr; `source` names the data; `command` makes the run again.
Page run_page(const RunRecord& record, const Summary& summary, const Recording& recording, const Truth* truth,
              const std::string& source, const std::string& command);

/// The stages at work in the steps that a record shows: a row a worker, one for what all stages wait for.
///
/// shape   the record has a timeline
Chart stage_chart(const StageRecord& record, const std::string& title);

}  // namespace mote::report
