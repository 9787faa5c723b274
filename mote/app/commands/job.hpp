#pragma once
/// A job: a model, its recording and truth, ready to be filtered by any plan.

#include <memory>
#include <optional>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/engine/recording.hpp"
#include "mote/engine/run.hpp"
#include "mote/report/page.hpp"

namespace mote {

struct Job {
  std::string model_name, data_path, command;
  std::shared_ptr<const CatalogueModel> model;
  Recording recording;
  std::optional<Truth> truth;
  std::vector<std::string> notes;  ///< columns that nobody reads
};

/// Reads a job's files; `truth_path` may be empty.
Job load_job(const std::string& model, const std::string& data_path, const std::string& truth_path,
             const std::vector<std::string>& settings, const std::string& where);

/// A request for the job's states and the functions asked for.
RunRequest request_for(const Job& job, const std::vector<std::string>& estimates, const std::string& where);

/// Refuses a plan that needs more memory than there is (Refusal, kWrongUse); `option` said its particles.
void check_memory(const Plan& plan, const Job& job, const std::string& where,
                  const std::string& option = "--particles");

/// Runs the plan on its engine.
///
/// error   Refusal: memory that does not suffice, a proposal that the model does not have (kWrongUse), collapse
///         (kCollapsed)
RunRecord run_job(const Job& job, const Plan& plan, const RunRequest& request, const std::string& where);

/// The same with a filter that has been made of the plan.
RunRecord run_filter(Filter& filter, const Job& job, const Plan& plan, const RunRequest& request);

/// The report page of a run as HTML; `facts` are shown after the run's own.
std::string report_for(const Job& job, const RunRecord& record, const Summary& summary,
                       const std::vector<report::Fact>& facts = {});

}  // namespace mote
