#pragma once
/// What `mote analog characterise` finds out: both circuits over the currents of MIXED's Table II, their dies, and the
/// weights that they make of a bearing.

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "mote/analog/characterise.hpp"
#include "mote/analog/weights.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/report/page.hpp"

namespace mote {

struct CharacteriseRequest {
  analog::Conditions conditions;
  std::uint32_t dies = 0;
  std::uint64_t seed = 1;
};

/// Dies of a circuit at one I_a, trimmed or as they were made.
struct DiesFound {
  analog::Function function;
  double ia_a;
  bool trimmed;
  analog::Dies dies;
};

struct Characterisation {
  CharacteriseRequest request;
  std::vector<analog::Behaviour> circuits;  ///< arctan, then Gaussian, by level and rising I_a
  std::vector<analog::Behaviour> trackers;  ///< the tracker's arctan and Gaussian, with their devices
  std::vector<DiesFound> dies;
  std::vector<analog::WeightCurve> weights;  ///< at the tracker's two sigma_r
};

/// The options of its request.
std::vector<OptionSpec> characterise_options();

/// error   Refusal (kWrongUse) for a number out of range
CharacteriseRequest characterise_request_from(const Arguments& arguments);

/// `done` is told how much of the work is done, of how much.
///
/// error   Refusal (kOutsideTool) when ngspice is missing or finds no solution
/// cost    some seconds, and 40 ms a die (each of two circuits, trimmed and as made)
Characterisation characterisation(const CharacteriseRequest& request,
                                  const std::function<void(std::size_t, std::size_t)>& done);

/// The circuits of one function and level, by rising I_a.
std::vector<const analog::Behaviour*> found_circuits(const Characterisation& found, analog::Function function,
                                                     analog::Level level);

/// {arctan, gaussian: the realistic level, ideal: {arctan, gaussian}, range, tracker, weights, dies, conditions}
nlohmann::json characterisation_json(const Characterisation& found);

std::string characterisation_text(const Characterisation& found);

report::Page characterisation_page(const Characterisation& found);

}  // namespace mote
