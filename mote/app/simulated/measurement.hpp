#pragma once
/// Measurement: what a particle takes on one core of this machine, for hosts that are not there.

#include <string>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/simulated/sweep.hpp"

namespace mote::simulated {

/// What runs on one core of this machine say.
struct Measurement {
  StageTimes times{};  ///< seconds a particle; on the SIMD engine all in the first
  double ess_share = 1;
};

/// The quickest of some runs of the model: by stages on the pipeline engine, else on the SIMD engine, where groups take
/// what SISR does: their particles are moved, weighed and resampled likewise.
///
/// error   Refusal (kWrongUse), opened by `where`, when the model has no proposal of that name
Measurement measured(const CatalogueModel& model, const Workload& work, const std::string& proposal,
                     const std::string& where);

}  // namespace mote::simulated
