#pragma once
/// The answer of `mote analog power`: Tables II, IV and V of MIXED from components, what they mean for a particle and a
/// step, and where the lines cross.

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/analog/power_request.hpp"
#include "mote/report/page.hpp"

namespace mote {

/// table2 {arctan, gaussian: {min, max}}, table4 {digital, mcml}, table5 {method1, method2, digital, method3: {rows,
/// printed, components: {uw, macs}}}, saving {printed_least, printed_most, printed_most_p_uw_for_20 (below 0: for no
/// P), table3_most_p_uw_for_20, ...}, p_uw, particle and step {nj, uj, ms}, crossover_hz; power in uW
nlohmann::json power_json(const PowerRequest& request);

/// The same for a reader.
std::string power_text(const PowerRequest& request);

/// The same as a page, with power against the rate of particles.
report::Page power_page(const PowerRequest& request, const std::string& command);

/// Power against the rate of particles, at P: a line for each implementation and reading, a point for each circuit.
report::Chart power_chart(const PowerRequest& request);

}  // namespace mote
