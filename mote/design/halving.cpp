#include "mote/design/halving.hpp"

#include <algorithm>
#include <numeric>

namespace mote::design {

std::vector<Rung> ladder(std::size_t candidates, const Rungs& rungs) {
  std::vector<Rung> all;
  if (candidates == 0) return all;
  all.push_back({candidates, 0, std::min(rungs.first, rungs.most)});
  while (all.back().last < rungs.most)
    all.push_back({(all.back().candidates + 1) / 2, all.back().last, std::min(2 * all.back().last, rungs.most)});
  return all;
}

Candidates halve(std::size_t candidates, const Rungs& rungs, const Judge& judge, const Ranked& ranked) {
  Candidates left(candidates);
  std::iota(left.begin(), left.end(), std::size_t{0});
  for (const Rung& rung : ladder(candidates, rungs)) {
    if (rung.candidates < left.size()) left = ranked(std::move(left));
    left.resize(rung.candidates);
    judge(left, rung.first, rung.last);
  }
  return left;
}

}  // namespace mote::design
