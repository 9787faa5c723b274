#pragma once
/// Filters in mixed mode.

#include <memory>
#include <string>

#include "mote/analog/method.hpp"
#include "mote/engine/plan.hpp"
#include "mote/filter/filter.hpp"
#include "mote/graph/record.hpp"

namespace mote::analog {

/// The filter of a plan on a recorded model whose analog parts are those of the design.
///
/// Method-1 and 2 take SISR and the IMH filters, Method-3 IMH alone, whose estimates are then the means of the chain's
/// states. With Method-2 and 3 the sums of an estimate are a multiplier's, whose gain differs from particle to
/// particle. The design's seed is that of its parts and noise.
///
/// shape   reference engine, double, proposal by the model
/// error   Refusal (kWrongUse): another filter, engine, precision or proposal; a behaviour for which the model has no
///         use, or none that it needs; a calibration without an arctangent that is subtracted from a measurement
std::unique_ptr<Filter> make_mixed_filter(const graph::Recorded& recorded, const Plan& plan, const Design& design,
                                          const std::string& where);

}  // namespace mote::analog
