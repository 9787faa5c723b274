#pragma once
/// Contenders: filters as words of a command line, made into plans.

#include <string>
#include <vector>

#include "mote/engine/plan.hpp"

namespace mote::compare {

/// One filter of a comparison with the plans that it runs.
struct Contender {
  std::string name;         ///< as given: "imh --improved"; a repeated one is numbered
  std::vector<Plan> plans;  ///< one for each number of particles
};

/// Reads "sisr; imh --improved": a filter's name, then options of `mote run` but for --particles and --seed. Options
/// that a filter does not read are added to `notes`.
///
/// error   Refusal (kWrongUse) naming the contender and the option
std::vector<Contender> contenders_from(const std::string& text, const std::vector<std::size_t>& particles,
                                       const std::string& where, std::vector<std::string>& notes);

/// Reads the filter of a reference run, "sisr -n 200000", whose particles are its own.
///
/// error   Refusal (kWrongUse)
Plan reference_plan(const std::string& text, const std::string& where, std::vector<std::string>& notes);

}  // namespace mote::compare
