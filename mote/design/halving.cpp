#include "mote/design/halving.hpp"

#include <algorithm>
#include <numeric>

namespace mote::design {

std::vector<std::size_t> halve(std::size_t candidates, const Rungs& rungs, const Judge& judge, const Ranked& ranked) {
  std::vector<std::size_t> runs(candidates, 0);
  Candidates left(candidates);
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::size_t done = 0;
  std::size_t wanted = std::min(rungs.first, rungs.most);
  while (!left.empty()) {
    judge(left, done, wanted);
    for (const std::size_t c : left) runs[c] = wanted;
    if (wanted == rungs.most) break;
    left = ranked(std::move(left));
    left.resize((left.size() + 1) / 2);
    done = wanted;
    wanted = std::min(2 * wanted, rungs.most);
  }
  return runs;
}

}  // namespace mote::design
