#include "mote/design/schedule.hpp"

#include <algorithm>
#include <deque>
#include <numeric>
#include <queue>
#include <vector>

namespace mote::design {
namespace {

/// One stage with its queue before it.
struct Stage {
  std::size_t workers = 1;
  double seconds = 0;
  std::size_t places = 0;  // of the queue; 0: no bound
  std::size_t free = 0;    // workers
  std::size_t coming = 0;  // taken places: on their way, or waiting
  std::deque<std::size_t> waiting = {}, blocked = {};
  std::vector<double> out = {}, in = {};  // when a worker's link is free
};

enum class Happens { kFinished, kArrived };

struct Event {
  double time;
  std::size_t item, stage;
  Happens what;
};

/// The earliest first; of equal times the furthest down the line, and of these the first particle.
struct Later {
  bool operator()(const Event& a, const Event& b) const {
    if (a.time != b.time) return a.time > b.time;
    if (a.stage != b.stage) return a.stage < b.stage;
    return a.item > b.item;
  }
};

class Play {
 public:
  explicit Play(const Line& line) : line_(line) {
    const auto stage = [&](std::size_t workers, double seconds) {
      return Stage{
          workers, seconds, line.queue, workers, 0, {}, {}, std::vector<double>(workers), std::vector<double>(workers)};
    };
    stages_ = {stage(line.proposers, line.times.propose), stage(line.weighers, line.times.weigh),
               stage(1, line.times.chain)};
    blocked_since_.resize(line.n);
  }

  Schedule run() {
    propose(0);
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      found_.makespan = event.time;
      if (event.what == Happens::kArrived) {
        stages_[event.stage].waiting.push_back(event.item);
        take_up(event.stage, event.time);
      } else {
        finish(event);
      }
    }
    found_.proposing = static_cast<double>(line_.n) * line_.times.propose;
    found_.weighing = static_cast<double>(line_.n) * line_.times.weigh;
    return found_;
  }

 private:
  void work(std::size_t stage, std::size_t item, double now) {
    --stages_[stage].free;
    events_.push({now + stages_[stage].seconds, item, stage, Happens::kFinished});
  }

  void propose(double now) {
    while (stages_[0].free > 0 && next_ < line_.n) work(0, next_++, now);
  }

  /// Free workers take what waits; that makes places for what is blocked before.
  void take_up(std::size_t stage, double now) {
    Stage& s = stages_[stage];
    while (s.free > 0 && !s.waiting.empty()) {
      const std::size_t item = s.waiting.front();
      s.waiting.pop_front();
      --s.coming;
      work(stage, item, now);
      Stage& before = stages_[stage - 1];
      if (before.blocked.empty()) continue;
      const std::size_t held = before.blocked.front();
      before.blocked.pop_front();
      found_.blocked += now - blocked_since_[held];
      send(stage, held, now);
      leave(stage - 1, now);
    }
    std::size_t& largest = found_.largest_queue[stage - 1];
    largest = std::max(largest, s.waiting.size());
  }

  bool has_place(const Stage& s) const {
    // a free worker takes what arrives at once
    return s.places == 0 || s.coming < s.places + s.free;
  }

  void finish(const Event& event) {
    if (event.stage == 2) return leave(2, event.time);
    if (!has_place(stages_[event.stage + 1])) {
      blocked_since_[event.item] = event.time;
      stages_[event.stage].blocked.push_back(event.item);
      return;
    }
    send(event.stage + 1, event.item, event.time);
    leave(event.stage, event.time);
  }

  void send(std::size_t to, std::size_t item, double now) {
    ++stages_[to].coming;
    const double busy = line_.message.link_seconds();
    double& out = stages_[to - 1].out[item % stages_[to - 1].workers];
    double& in = stages_[to].in[item % stages_[to].workers];
    const double sent = std::max({now, out, in}) + busy;
    out = in = sent;
    events_.push({sent + line_.message.latency_s, item, to, Happens::kArrived});
  }

  void leave(std::size_t stage, double now) {
    ++stages_[stage].free;
    if (stage == 0) return propose(now);
    take_up(stage, now);
  }

  const Line& line_;
  std::vector<Stage> stages_;
  std::vector<double> blocked_since_;
  std::priority_queue<Event, std::vector<Event>, Later> events_;
  std::size_t next_ = 0;
  Schedule found_;
};

}  // namespace

Schedule schedule(const Line& line) { return Play(line).run(); }

double makespan(const Line& line) {
  const auto rw = static_cast<double>(line.weighers);
  const std::size_t rounds = (line.n - 1) / line.proposers;
  const auto [propose, weigh, chain] = line.times;
  // linear in k: its ends alone can be the largest
  const auto waiting = [&](std::size_t q) {
    const std::size_t left = line.n - 1 - q * line.proposers;
    const double k = weigh > rw * chain ? static_cast<double>(left / line.weighers) : 0.0;
    return static_cast<double>(q + 1) * propose + (k + 1) * weigh + (static_cast<double>(left + 1) - k * rw) * chain;
  };
  // left mod R_w has a period in q, from one period to the next the rest grows by the same: the first and last suffice
  const std::size_t period =
      weigh > rw * chain ? std::min(rounds + 1, line.weighers / std::gcd(line.weighers, line.proposers)) : 1;
  double longest = 0;
  for (std::size_t q = 0; q < period; ++q) longest = std::max({longest, waiting(q), waiting(rounds - q)});
  return longest;
}

}  // namespace mote::design
