#pragma once
/// The search: what candidates take, how far they err, the frontier of both, and the pick.

#include <atomic>
#include <functional>

#include "mote/app/compare/statistics.hpp"
#include "mote/app/explore/jury.hpp"
#include "mote/design/frontier.hpp"
#include "mote/design/halving.hpp"

namespace mote::explore {

/// What is asked for. Figures are the target's and, behind them, the error.
struct Order {
  std::vector<design::Limit> limits;
  std::size_t goal = 0;
  design::Rungs rungs;
  std::size_t threads = 1;
};

/// What is known of a candidate.
struct Standing {
  std::vector<double> takes;  ///< figure by figure; infinite if it collapsed before they were found
  std::size_t runs = 0;       ///< that judged it; 0: it is far over a limit, or collapsed
  bool collapsed = false;     ///< all its weights were zero, in a run or while it was timed
  double rmse = 0;            ///< to the reference's means, root of the mean over runs and steps; infinite if collapsed
  compare::Interval interval{0, 0};  ///< of it, 95 %
  double rmse_truth = 0;             ///< to the true states; NaN where they are not known
};

/// The answer.
struct Finding {
  std::vector<Standing> standings;    ///< by candidate
  std::vector<std::size_t> frontier;  ///< of those whom all runs judged, whom none other beats; the least error first
  std::size_t pick = 0;
  bool feasible = false;
  std::vector<std::size_t> broken;  ///< limits that the pick exceeds, where nothing keeps them all
};

/// Told of what is done and all that there is to do: "parts", "candidates", then "runs".
using Told = std::function<void(const char* what, std::size_t done, std::size_t all)>;

/// Finds what every candidate takes; judges by successive halving those that are within four times the limits on that
/// (or within four times what the nearest exceeds them by); picks among those that are left.
///
/// Halving keeps candidates by the factor by which they exceed the limits on what they take; then by frontiers of goal
/// and error, the first one first, because who errs less is known better than how much all of them do (runs are common
/// to all); of one frontier those nearest to the limit on the error. Whoever nobody beats by the runs that both have
/// had is judged by all runs then, as the finalists are: the frontier compares equal runs.
///
/// error   Refusal (kCollapsed) when every candidate that was judged collapsed; (kInterrupted) after a signal: what was
/// found is in the journal
Finding search(const Target& target, const Jury& jury, Journal& journal, const Order& order, const Told& told,
               const std::atomic<bool>& stop);

}  // namespace mote::explore
