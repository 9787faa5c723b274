#pragma once
/// Successive halving: many candidates are judged by a few runs each, the better ones by more.

#include <cstddef>
#include <functional>
#include <vector>

namespace mote::design {

/// Candidates by their numbers, in any order.
using Candidates = std::vector<std::size_t>;

/// How many runs judge a candidate: at first, and of those that are left in the end.
struct Rungs {
  std::size_t first = 8, most = 128;
};

/// A step of the search: so many candidates are judged by runs [first, last).
struct Rung {
  std::size_t candidates = 0, first = 0, last = 0;
};

/// The rungs for so many candidates: from one to the next half of them, at least one, and twice the runs.
std::vector<Rung> ladder(std::size_t candidates, const Rungs& rungs);

/// Makes runs [first, last) of each of the candidates. Run r has the same data and the same seed for all of them
/// (common random numbers), so that their differences vary less than they do.
using Judge = std::function<void(const Candidates&, std::size_t first, std::size_t last)>;

/// Puts candidates into their order by what the runs made so far say, the best first.
using Ranked = std::function<Candidates(Candidates)>;

/// Goes up the ladder: those that are left are judged, and the better of them go on. Gives the finalists, who were
/// judged by all runs.
///
/// cost    about `first` runs a candidate for each of the log2(most / first) + 1 rungs
/// source  Karnin, Koren & Somekh 2013; Jamieson & Talwalkar 2016
Candidates halve(std::size_t candidates, const Rungs& rungs, const Judge& judge, const Ranked& ranked);

}  // namespace mote::design
