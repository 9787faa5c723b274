#pragma once

#include <span>
#include <string>

#include "mote/report/page.hpp"

namespace mote::report {

/// The charts as a JSON array that may stand inside a <script> element: "<" is written \u003c, so no text ends the
/// element. Non-finite numbers become null.
///
/// error   std::invalid_argument if the columns of a series or band differ in length
std::string chart_json(std::span<const Chart> charts);

/// How many significant digits show `values` at 1e-6 of their range: 7, and one more for each decimal place by which
/// an offset exceeds the range (time stamps), at most 17.
int digits_needed(std::span<const double> values);

}  // namespace mote::report
