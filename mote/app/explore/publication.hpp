#pragma once
/// What an exploration leaves: the pick's command and the frontier for a terminal, JSON, a page.

#include <nlohmann/json_fwd.hpp>

#include "mote/app/explore/search.hpp"
#include "mote/report/page.hpp"

namespace mote::explore {

/// An exploration with its answer.
struct Exploration {
  std::string model, command, source;
  std::string data;  ///< the recording's file, that commands run on
  const Target* target = nullptr;
  const Jury* jury = nullptr;
  Order order;
  Finding finding;

  /// The target's figures, and the error behind them.
  std::vector<Figure> figures() const;
  /// What a candidate comes to, figure by figure.
  double value(std::size_t candidate, std::size_t figure) const;
  std::string command_of(std::size_t candidate) const { return target->command(candidate, data); }
};

/// {model, target, source, reference, goal, limits, candidates, pick, frontier, all}: candidates with `words`,
/// `command`, their figures, `rmse`, `rmse_interval`, `rmse_truth`, `runs`, `collapsed`; of the pick also `feasible`,
/// `breaks` and by which factor; null stands for what is not known.
nlohmann::json exploration_json(const Exploration& found);

/// The frontier, the pick, and in the last line its command.
std::string exploration_text(const Exploration& found);

/// One HTML file: error against each axis of the frontier, every point with its command.
report::Page exploration_page(const Exploration& found);

}  // namespace mote::explore
