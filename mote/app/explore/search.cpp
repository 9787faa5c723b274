#include "mote/app/explore/search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "mote/base/numbers.hpp"
#include "mote/base/parallel.hpp"
#include "mote/base/refusal.hpp"

namespace mote::explore {
namespace {

using design::Candidates;
using design::Limit;
using design::Point;

/// Beyond this factor over a limit nobody is judged.
constexpr double kFar = 4;
constexpr double kSigmas = 1.96;

/// One search in progress.
class Search {
 public:
  Search(const Target& target, const Jury& jury, Journal& journal, const Order& order, const Told& told,
         const std::atomic<bool>& stop)
      : target_(target),
        jury_(jury),
        journal_(journal),
        order_(order),
        told_(told),
        stop_(stop),
        error_(target.figures().size()),
        standings_(target.candidates().size()),
        sums_(target.candidates().size()) {}

  Finding finding() {
    find_takes();
    const Candidates near = within_reach();
    for (const design::Rung& rung : design::ladder(near.size(), order_.rungs))
      all_runs_ += rung.candidates * (rung.last - rung.first);
    design::halve(
        near.size(), order_.rungs,
        [&](const Candidates& places, std::size_t first, std::size_t last) { judge(at(near, places), first, last); },
        [&](const Candidates& places) { return places_in(near, ranked(at(near, places))); });
    for (Candidates short_of = unbeaten(near); !short_of.empty(); short_of = unbeaten(near)) finish(short_of);
    return chosen(near);
  }

 private:
  static Candidates at(const Candidates& near, const Candidates& places) {
    Candidates all;
    for (const std::size_t place : places) all.push_back(near[place]);
    return all;
  }
  static Candidates places_in(const Candidates& near, const Candidates& candidates) {
    Candidates all;  // `near` grows
    for (const std::size_t c : candidates)
      all.push_back(static_cast<std::size_t>(std::lower_bound(near.begin(), near.end(), c) - near.begin()));
    return all;
  }

  std::size_t threads_for_takes() const { return target_.measures() ? 1 : order_.threads; }
  void find_takes() {
    std::atomic<std::size_t> pieces{0};
    const std::vector<Piece> shared = target_.shared_work();
    in_parallel(shared.size(), threads_for_takes(), [&](std::size_t k) {
      refuse_stopped();
      shared[k](journal_);
      tell("parts", ++pieces, shared.size());
    });
    std::atomic<std::size_t> done{0};
    in_parallel(standings_.size(), threads_for_takes(), [&](std::size_t c) {
      refuse_stopped();
      find_takes_of(c);
      tell("candidates", ++done, standings_.size());
    });
  }
  /// Whoever collapses while it is timed is out, and nobody else.
  void find_takes_of(std::size_t c) {
    Standing& s = standings_[c];
    try {
      s.takes = target_.takes(c, journal_);
    } catch (const Refusal& refusal) {
      if (refusal.code() != ExitCode::kCollapsed) throw;
      s.collapsed = true;
      s.takes.assign(error_, kInfinity);
    }
  }

  /// Limits on what candidates take, without that on the error.
  std::vector<Limit> known_limits() const {
    std::vector<Limit> all = order_.limits;
    std::erase_if(all, [&](const Limit& limit) { return limit.figure == error_; });
    return all;
  }
  Candidates within_reach() const {
    const std::vector<Limit> limits = known_limits();
    double least = kInfinity;
    for (const Standing& s : standings_)
      if (!s.collapsed) least = std::min(least, design::excess(s.takes, limits));
    Candidates all;
    for (std::size_t c = 0; c < standings_.size(); ++c)
      if (!standings_[c].collapsed && design::excess(standings_[c].takes, limits) <= kFar * least) all.push_back(c);
    return all;
  }

  /// Runs one after the other on many threads, those of a recording together.
  void judge(const Candidates& judged, std::size_t first, std::size_t last) {
    in_parallel(judged.size() * (last - first), order_.threads, [&](std::size_t k) {
      refuse_stopped();
      const std::size_t c = judged[k % judged.size()];
      const std::size_t run = first + k / judged.size();
      if (!journal_.errors(c, run)) journal_.keep(c, run, jury_.judged(target_, c, run));
      tell("runs", ++done_runs_, all_runs_);
    });
    for (const std::size_t c : judged) sum_up(c, last);
  }

  /// The mean and, from the spread of the runs, an interval.
  void sum_up(std::size_t c, std::size_t runs) {
    double sum = 0;
    double squares = 0;
    double truth = 0;
    std::vector<double>& sums = sums_[c];
    sums.assign(1, 0);
    for (std::size_t run = 0; run < runs; ++run) {
      const Errors e = *journal_.errors(c, run);
      sums.push_back(sum += e.reference);
      squares += e.reference * e.reference;
      truth += e.truth;
    }
    const auto n = static_cast<double>(runs);
    const double mean = sum / n;
    const double spread = runs < 2 || std::isinf(mean)
                              ? kInfinity
                              : kSigmas * std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1));
    Standing& s = standings_[c];
    s.runs = runs;
    s.collapsed = std::isinf(mean);
    s.rmse = std::sqrt(mean);
    s.interval = {std::isinf(mean) ? mean : std::sqrt(std::max(0.0, mean - spread)), std::sqrt(mean + spread)};
    s.rmse_truth = std::sqrt(truth / n);
  }

  /// Makes the runs that candidates are short of.
  void finish(const Candidates& short_of) {
    for (const std::size_t c : short_of) all_runs_ += order_.rungs.most - standings_[c].runs;
    std::map<std::size_t, Candidates> by_runs;
    for (const std::size_t c : short_of) by_runs[standings_[c].runs].push_back(c);
    for (const auto& [runs, candidates] : by_runs) judge(candidates, runs, order_.rungs.most);
  }

  /// What counts on the frontier beside the error.
  Point axes_of(std::size_t c) const {
    const std::vector<Figure> figures = target_.figures();
    Point all;
    for (std::size_t f = 0; f < figures.size(); ++f)
      if (figures[f].axis) all.push_back(standings_[c].takes[f]);
    return all;
  }
  /// Whether a is on no axis and in no error, by the runs that both have had, more than b, and somewhere less.
  bool beats(std::size_t a, std::size_t b) const {
    const std::size_t common = std::min(standings_[a].runs, standings_[b].runs);
    Point of_a = axes_of(a);
    Point of_b = axes_of(b);
    of_a.push_back(sums_[a][common]);
    of_b.push_back(sums_[b][common]);
    return design::dominates(of_a, of_b);
  }
  /// Candidates that nobody beats, and that not all runs have judged yet.
  Candidates unbeaten(const Candidates& near) const {
    Candidates all = near;
    std::erase_if(all, [&](std::size_t b) {
      return standings_[b].collapsed || standings_[b].runs >= order_.rungs.most ||
             std::any_of(near.begin(), near.end(),
                         [&](std::size_t a) { return !standings_[a].collapsed && beats(a, b); });
    });
    return all;
  }

  Point point(std::size_t c, double error) const {
    Point all = standings_[c].takes;
    all.push_back(error);
    return all;
  }
  double goal_of(std::size_t c) const {
    return order_.goal == error_ ? standings_[c].rmse : standings_[c].takes[order_.goal];
  }
  /// The limit on the error; infinite: none.
  double most_error() const {
    double most = kInfinity;
    for (const Limit& limit : order_.limits)
      if (limit.figure == error_) most = std::min(most, limit.most);
    return most;
  }
  /// How many frontiers of goal and error lie before each candidate's own.
  std::vector<std::size_t> depths_of(const Candidates& all) const {
    std::vector<std::size_t> depths(standings_.size(), 0);
    Candidates left = all;
    std::erase_if(left, [&](std::size_t c) { return standings_[c].collapsed; });
    for (std::size_t depth = 0; !left.empty(); ++depth) {
      std::vector<Point> points;
      for (const std::size_t c : left) points.push_back({goal_of(c), standings_[c].rmse});
      const Candidates front = at(left, design::frontier(points));
      for (const std::size_t c : front) depths[c] = depth;
      std::erase_if(left, [&](std::size_t c) { return std::find(front.begin(), front.end(), c) != front.end(); });
    }
    return depths;
  }
  Candidates ranked(Candidates all) const {
    const std::vector<Limit> known = known_limits();
    const double most = most_error();
    const std::vector<std::size_t> depths = depths_of(all);
    const auto key = [&](std::size_t c) {
      const double apart = std::isinf(most) ? 0 : std::abs(std::log(standings_[c].rmse / most));
      return std::tuple(standings_[c].collapsed, design::excess(standings_[c].takes, known), depths[c], apart,
                        goal_of(c), c);
    };
    std::sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    return all;
  }

  /// The pick and the frontier are among those whom all runs have judged.
  Finding chosen(const Candidates& near) const {
    Candidates left = near;
    std::erase_if(left,
                  [&](std::size_t c) { return standings_[c].collapsed || standings_[c].runs < order_.rungs.most; });
    if (left.empty()) refuse_collapsed();
    std::vector<Point> points;
    for (const std::size_t c : left) points.push_back(point(c, standings_[c].rmse));
    const design::Choice choice = design::best_within(points, order_.limits, order_.goal);
    return {standings_, frontier_of(left), left[choice.place], choice.feasible, choice.broken};
  }
  Candidates frontier_of(const Candidates& finalists) const {
    std::vector<Point> points;
    for (const std::size_t c : finalists) {
      points.push_back(axes_of(c));
      points.back().push_back(standings_[c].rmse);
    }
    Candidates found = at(finalists, design::frontier(points));
    std::stable_sort(found.begin(), found.end(),
                     [&](std::size_t a, std::size_t b) { return standings_[a].rmse < standings_[b].rmse; });
    return found;
  }
  [[noreturn]] void refuse_collapsed() const {
    throw Refusal(ExitCode::kCollapsed,
                  {jury_.design().where, target_.name(), "a candidate whose weights are not all zero", "none",
                   "Pass larger --particles, other --kinds, or looser budgets."});
  }

  void tell(const char* what, std::size_t done, std::size_t all) {
    const std::lock_guard lock(telling_);
    told_(what, done, all);
  }
  void refuse_stopped() const {
    if (stop_)
      throw Refusal(ExitCode::kInterrupted, jury_.design().where +
                                                ": interrupted; no output was written. The same command goes on where "
                                                "it was, if it has --state or --json.");
  }

  const Target& target_;
  const Jury& jury_;
  Journal& journal_;
  const Order& order_;
  const Told& told_;
  const std::atomic<bool>& stop_;
  std::size_t error_;  ///< the figure behind those of the target
  std::vector<Standing> standings_;
  std::vector<std::vector<double>> sums_;  ///< of a candidate's errors over its first runs
  std::atomic<std::size_t> done_runs_{0};
  std::size_t all_runs_ = 0;
  std::mutex telling_;
};

}  // namespace

Finding search(const Target& target, const Jury& jury, Journal& journal, const Order& order, const Told& told,
               const std::atomic<bool>& stop) {
  return Search(target, jury, journal, order, told, stop).finding();
}

}  // namespace mote::explore
