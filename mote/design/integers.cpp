#include "mote/design/integers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace mote::design {
namespace {

constexpr double kSame = 1e-12;  // relative: rounding of sums of times
constexpr std::size_t kMostSchedules = 100'000;
constexpr double kWorst = std::numeric_limits<double>::max();

/// By how much the limits are exceeded (1: they hold), goal, blocks, time: compared in this order.
using Rank = std::array<double, 4>;

bool less(const Rank& a, const Rank& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > kSame * std::abs(b[i])) return a[i] < b[i];
  return false;
}

/// Choices [p, p_to] x [w, w_to] on so many chains.
struct Box {
  std::size_t chains, p, p_to, w, w_to;
  Rank least;

  bool single() const { return p == p_to && w == w_to; }
};

struct Worse {
  bool operator()(const Box& a, const Box& b) const { return less(b.least, a.least); }
};

class Search {
 public:
  Search(const Demand& demand, std::size_t queue, const Message& message)
      : d_(demand), queue_(queue), message_(message) {}

  WholeAnswer run() {
    for (std::size_t chains = 1; chains <= d_.most_chains; ++chains) {
      const std::size_t n = line_of(d_, 1, 1, chains).n;
      open({chains, 1, n, 1, n, {}});
    }
    while (!boxes_.empty() && found_.schedules < kMostSchedules) {
      const Box box = boxes_.top();
      boxes_.pop();
      if (!less(box.least, best_)) break;  // and so are all the others
      split(box);
    }
    found_.proven = boxes_.empty() || !less(boxes_.top().least, best_);
    found_.feasible = best_[0] <= 1 + kSame;
    judge();
    return found_;
  }

 private:
  double time(std::size_t p, std::size_t w, std::size_t chains) {
    ++found_.schedules;
    const Line line = line_of(d_, p, w, chains, queue_, message_);
    return queue_ == 0 && message_.latency_s == 0 && message_.link_seconds() == 0 ? makespan(line)
                                                                                  : schedule(line).makespan;
  }

  WholePlant plant(std::size_t p, std::size_t w, std::size_t chains, double time) const {
    const auto rp = static_cast<double>(p);
    const auto rw = static_cast<double>(w);
    return {
        p, w, chains, time, blocks_of(d_, rp, rw, static_cast<double>(chains)), energy_of(d_, rp, rw, chains, time)};
  }

  Rank rank(const WholePlant& plant) const {
    double excess = 1;
    if (d_.deadline) excess = std::max(excess, plant.exact_time / *d_.deadline);
    if (d_.most_blocks) excess = std::max(excess, plant.blocks / *d_.most_blocks);
    if (d_.most_energy) excess = std::max(excess, plant.energy / *d_.most_energy);
    const double goal = d_.goal == Goal::kTime     ? plant.exact_time
                        : d_.goal == Goal::kBlocks ? plant.blocks
                                                   : plant.energy;
    return {excess, goal, plant.blocks, plant.exact_time};
  }

  void consider(const WholePlant& plant) {
    const Rank rank = this->rank(plant);
    if (!less(rank, best_)) return;
    found_.plant = plant;
    best_ = rank;
  }

  void judge() {
    const auto broken = [](double value, const std::optional<double>& most) {
      return most && value > *most * (1 + kSame);
    };
    found_.breaks_deadline = broken(found_.plant.exact_time, d_.deadline);
    found_.breaks_blocks = broken(found_.plant.blocks, d_.most_blocks);
    found_.breaks_energy = broken(found_.plant.energy, d_.most_energy);
  }

  /// Bounds a box, looks at its corners, and keeps it if something in it may be better.
  void open(Box box) {
    const double least_time = time(box.p_to, box.w_to, box.chains);
    consider(plant(box.p_to, box.w_to, box.chains, least_time));
    if (box.single()) return;
    consider(plant(box.p, box.w, box.chains, time(box.p, box.w, box.chains)));
    // fewest blocks in the least time
    box.least = rank(plant(box.p, box.w, box.chains, least_time));
    if (!less(box.least, best_)) return;
    boxes_.push(box);
  }

  void split(const Box& box) {
    const auto middle = [](std::size_t a, std::size_t b) {  // of logarithms: shares count, not numbers
      const auto m = static_cast<std::size_t>(std::sqrt(static_cast<double>(a) * static_cast<double>(b)));
      return std::clamp(m, a, b - 1);
    };
    const bool by_proposers = static_cast<double>(box.p_to) * static_cast<double>(box.w) >=
                              static_cast<double>(box.w_to) * static_cast<double>(box.p);
    Box low = box;
    Box high = box;
    if (by_proposers) {
      low.p_to = middle(box.p, box.p_to);
      high.p = low.p_to + 1;
    } else {
      low.w_to = middle(box.w, box.w_to);
      high.w = low.w_to + 1;
    }
    open(low);
    open(high);
  }

  const Demand& d_;
  std::size_t queue_;
  Message message_;
  std::priority_queue<Box, std::vector<Box>, Worse> boxes_;
  WholeAnswer found_;
  Rank best_{kWorst, kWorst, kWorst, kWorst};
};

}  // namespace

Line line_of(const Demand& d, std::size_t proposers, std::size_t weighers, std::size_t chains, std::size_t queue,
             const Message& message) {
  const std::size_t share = (d.kept + chains - 1) / chains;
  return {d.burn_in + share, d.times, proposers, weighers, queue, message};
}

WholeAnswer optimise_whole(const Demand& demand, std::size_t queue, const Message& message) {
  return Search(demand, queue, message).run();
}

}  // namespace mote::design
