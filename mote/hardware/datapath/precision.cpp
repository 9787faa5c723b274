#include "mote/hardware/datapath/precision.hpp"

#include <algorithm>
#include <cmath>

#include "mote/graph/words.hpp"
#include "mote/hardware/datapath/draws.hpp"
#include "mote/hardware/datapath/reach.hpp"
#include "mote/hardware/datapath/tape.hpp"

namespace mote::hardware {
namespace {

using graph::Id;
using graph::Interval;
using graph::Op;
using graph::Role;
using graph::Vertex;

constexpr double kNoiseShare = 16, kErrorShare = 32;         // a step is at most such a part of either
constexpr double kLogStep = 1.0 / 16, kStateLogStep = 0.25;  // octaves
constexpr double kFaintOctaves = 8;
// times what is borne in the mean that no sample may exceed; of pairs less, whose log density is steep in few places
constexpr double kWorst = 8, kWorstOfPairs = 0.25;
// after the point of numbers about 1, and of the smallest
constexpr int kMostFraction = 30, kMostOfSmall = 96;
constexpr int kMostBits = 40;
constexpr int kWideState = 26;    // bits from which on it is asked whether only particles that have run away need them
constexpr int kConstantBits = 3;  // more: a constant's error is the same for all particles

/// Mean squares of slopes, each finite one, and the largest.
struct Squares {
  double sum = 0, largest = 0;
  std::size_t count = 0;
  void add(double value) {
    if (!std::isfinite(value)) return;
    sum += value * value;
    largest = std::max(largest, value * value);
    ++count;
  }
  double mean() const { return count == 0 ? 0 : sum / static_cast<double>(count); }
};

bool is_normal(const Vertex& v) {
  return v.op == Op::kInput && (v.role == Role::kNormal || v.role == Role::kPriorNormal);
}
bool is_draw(const Vertex& v) {
  return is_normal(v) || (v.op == Op::kInput && (v.role == Role::kUniform || v.role == Role::kPriorUniform));
}
bool is_function(Op op) {
  return op == Op::kDivide || op == Op::kSqrt || op == Op::kExp || op == Op::kLog || op == Op::kSin || op == Op::kCos ||
         op == Op::kTan || op == Op::kAtan || op == Op::kAtan2;
}

/// Bits of a function's result that no table of polynomials is exact to.
int beyond_tables(Op op, const Format& y) {
  if (op == Op::kDivide || op == Op::kExp) return y.integer + y.fraction - 22;
  if (op == Op::kSin || op == Op::kCos) return std::max(y.width(), y.fraction) - 24;
  if (op == Op::kAtan || op == Op::kAtan2) return y.fraction - 21;
  return y.width() - 24;
}

class Analysis {
 public:
  Analysis(const Plan& plan, const graph::Recorded& recorded, const Samples& samples)
      : plan_(plan),
        recorded_(recorded),
        samples_(samples),
        seen_(plan.graph.size(), {kInfinity, -kInfinity}),
        need_(plan.graph.size(), 0.0) {}

  Precision precision(double margin, int more_bits) {
    const std::vector<double> steps = state_steps();
    std::vector<double> first = noise_of(Part::kInitial);
    for (std::size_t d = 0; d < steps.size(); ++d) first[d] = std::max(steps[d], first[d] / kNoiseShare);
    of_states(Part::kInitial, first);
    of_states(Part::kNext, steps);
    of_log_weight();
    of_decisions();
    return formats(margin, more_bits, steps);
  }

 private:
  void watch(const Tape& tape) {
    for (const Id id : tape.order()) {
      if (!std::isfinite(tape.value(id))) continue;
      seen_[id].low = std::min(seen_[id].low, tape.value(id));
      seen_[id].high = std::max(seen_[id].high, tape.value(id));
    }
  }
  /// A vertex is to be known to a step of at most 1 / need.
  void need(Id id, double more) { need_[id] = std::max(need_[id], more); }

  /// The standard deviation that draws give to each state, its parent given.
  std::vector<double> noise_of(Part part) const {
    Tape tape(plan_, recorded_, part);
    const std::vector<Id> outputs = plan_.outputs(part);
    std::vector<double> noise(outputs.size());
    for (const auto& call : samples_.of(part)) {
      tape.evaluate(call);
      for (std::size_t d = 0; d < noise.size(); ++d) {
        tape.differentiate(outputs[d]);
        for (const Id id : tape.order())
          if (is_draw(plan_.graph[id]) && std::isfinite(tape.slope(id)))
            noise[d] += tape.slope(id) * tape.slope(id) / (is_normal(plan_.graph[id]) ? 1 : 12);
      }
    }
    for (double& sum : noise) sum = std::sqrt(sum / static_cast<double>(samples_.of(part).size()));
    return noise;
  }

  /// The step that each state can bear.
  std::vector<double> state_steps() const {
    std::vector<double> steps = noise_of(Part::kNext);
    for (std::size_t d = 0; d < steps.size(); ++d) {
      double step = steps[d] > 0 ? steps[d] / kNoiseShare : kInfinity;
      if (samples_.errors[d] > 0) step = std::min(step, samples_.errors[d] / kErrorShare);
      steps[d] = std::isfinite(step) ? step : 0x1p-12;
    }
    return steps;
  }

  void of_states(Part part, const std::vector<double>& steps) {
    Tape tape(plan_, recorded_, part);
    const std::vector<Id> outputs = plan_.outputs(part);
    std::vector<Squares> squares(plan_.graph.size());
    for (std::size_t d = 0; d < outputs.size(); ++d) {
      squares.assign(squares.size(), {});
      for (const auto& call : samples_.of(part)) {
        tape.evaluate(call);
        if (d == 0) watch(tape);
        tape.differentiate(outputs[d]);
        for (const Id id : tape.order()) squares[id].add(tape.slope(id));
      }
      for (const Id id : tape.order()) need(id, std::sqrt(squares[id].mean()) / steps[d]);
    }
  }

  void of_log_weight() {
    Tape tape(plan_, recorded_, Part::kWeigh);
    std::vector<Squares> squares(plan_.graph.size());
    const double worst = recorded_.log_ratio ? kWorstOfPairs : kWorst;
    double greatest = -kInfinity;
    for (const auto& call : samples_.of(Part::kWeigh)) {
      tape.evaluate(call);
      greatest = std::max(greatest, tape.value(plan_.log_weight));
    }
    for (const auto& call : samples_.of(Part::kWeigh)) {
      tape.evaluate(call);
      watch(tape);
      tape.differentiate(plan_.log_weight);
      const double faint = 1 + (greatest - tape.value(plan_.log_weight)) / kFaintOctaves;
      for (const Id id : tape.order()) squares[id].add(tape.slope(id) / faint);
    }
    for (const Id id : tape.order()) {
      const Role role = plan_.graph[id].role;
      const bool state = plan_.graph[id].op == Op::kInput && (role == Role::kState || role == Role::kBefore);
      // the logarithm of a density is steep where the density is small: rare, but then an error of octaves
      const double slope = std::sqrt(std::max(squares[id].mean(), squares[id].largest / (worst * worst)));
      need(id, slope / (state ? kStateLogStep : kLogStep));
    }
  }

  /// What floor() and comparisons read.
  void of_decisions() {
    for (Id id = 0; id < plan_.graph.size(); ++id) {
      const Vertex& v = plan_.graph[id];
      if (v.op == Op::kFloor) need(v.args[0], 256);
      if (v.op == Op::kSelect && plan_.seen_bit(v.args[0]) < 0)
        for (const Id arg : {v.args[0], v.args[1]})
          if (!plan_.graph.is_constant(arg) && seen_[arg].low < seen_[arg].high)
            need(arg, 1024 / (seen_[arg].high - seen_[arg].low));
    }
    // a difference compared with 0 is known as well as its parts: a constant must be, too
    for (Id id = 0; id < plan_.graph.size(); ++id)
      if (const Vertex& v = plan_.graph[id]; v.op == Op::kSelect && plan_.seen_bit(v.args[0]) < 0) {
        const double both = std::max(need_[v.args[0]], need_[v.args[1]]);
        need(v.args[0], both);
        need(v.args[1], both);
      }
    spread_to_operands();
  }

  /// Sums and products hand on what decisions need: their slopes by samples are 0.
  void spread_to_operands() {
    for (Id id = static_cast<Id>(plan_.graph.size()); id-- > 0;) {
      const Vertex& v = plan_.graph[id];
      if (v.op == Op::kAdd || v.op == Op::kSubtract || v.op == Op::kNegate)
        for (const Id arg : v.operands())
          if (need_[arg] == 0) need(arg, need_[id]);
      if (v.op != Op::kMultiply) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        const Id other = v.args[1 - k];
        const bool whole = plan_.graph[other].op == Op::kFloor;  // it may come to 1 where samples have only 0
        const double most = std::max({whole ? 1.0 : 0.0, std::abs(seen_[other].low), std::abs(seen_[other].high)});
        if ((need_[v.args[k]] == 0 || whole) && std::isfinite(most)) need(v.args[k], need_[id] * most);
      }
    }
  }

  /// Angles can be all angles; of data, more is to be expected than was sampled.
  void widen_inputs() {
    for (Id id = 0; id < plan_.graph.size(); ++id) {
      const Vertex& v = plan_.graph[id];
      Interval& seen = seen_[id];
      if (v.op != Op::kInput || !(seen.low <= seen.high) || plan_.seen_bit(id) >= 0) continue;
      const bool column = v.role == Role::kColumn;
      const bool state = v.role == Role::kState || v.role == Role::kBefore;
      if ((column && recorded_.columns[v.index].angle) || (state && recorded_.states[v.index].angle))
        seen = {std::min(seen.low, -kPi), std::max(seen.high, kPi)};
      if (column && seen.low == seen.high) seen = {seen.low - 1, seen.high + 1};
    }
  }

  Precision formats(double margin, int more_bits, const std::vector<double>& steps) {
    widen_inputs();
    graph::Recorded shell;
    shell.graph = plan_.graph;
    const graph::Ranges ranges = graph::ranges(shell, seen_, margin);
    Precision all{std::vector<Format>(plan_.graph.size()), {}};
    for (Id id = 0; id < plan_.graph.size(); ++id) all.formats[id] = format_of(id, ranges, fraction_of(id, more_bits));
    set_states(all, ranges, more_bits, steps);
    return all;
  }

  int fraction_of(Id id, int more_bits) const {
    const double bits = need_[id] > 0 ? std::ceil(std::log2(need_[id])) : 0;
    const bool constant = plan_.graph.is_constant(id);
    if (plan_.graph[id].op == Op::kFloor) return 0;
    return std::clamp(static_cast<int>(bits) + more_bits + (constant ? kConstantBits : 0),
                      constant ? -kMostFraction : 0, most_fraction(id));
  }

  /// Numbers far below 1 have as many bits as those about 1: units are the user's.
  int most_fraction(Id id) const {
    const double size = std::max(std::abs(seen_[id].low), std::abs(seen_[id].high));
    const bool small = std::isfinite(size) && size > 0 && size < 1;
    return std::min(kMostOfSmall, kMostFraction - (small ? std::ilogb(size) : 0));
  }

  Format format_of(Id id, const graph::Ranges& ranges, int fraction) const {
    const Vertex& v = plan_.graph[id];
    if (plan_.seen_bit(id) >= 0) return {false, 1, 0};
    if (is_normal(v)) return {true, 3, std::clamp(fraction, 4, 18)};
    if (is_draw(v)) return {false, 1, std::clamp(fraction, 4, kPriorBits)};
    if (v.op == Op::kConstant) return constant_format(v.value, fraction);
    const auto by = [&](const Interval& range) { return graph::format_for(range, fraction, kMostBits); };
    Format format = by(v.op == Op::kFloor ? ranges.analysed[id] : ranges.kept[id]);
    if (const Format safe = by(ranges.analysed[id]); safe.width() <= format.width() + 2) format = safe;
    if (is_function(v.op)) format.fraction -= std::max(0, beyond_tables(v.op, format));
    return format;
  }

  /// A constant in as few bits as say the same at that fraction.
  static Format constant_format(double value, int fraction) {
    Format format = graph::format_for({value, value}, fraction, kMostBits);
    Word word = format.nearest(value);
    while (format.width() > 1 && word != 0 && word % 2 == 0) {
      word /= 2;
      --format.fraction;
    }
    return format;
  }

  /// States have one width; what more bits that gives a state come after its point.
  void set_states(Precision& all, const graph::Ranges& ranges, int more_bits, const std::vector<double>& steps) {
    const std::size_t dims = plan_.next.size();
    int width = 0;
    for (std::size_t d = 0; d < dims; ++d) {
      Interval range{kInfinity, -kInfinity};
      int fraction = static_cast<int>(std::ceil(-std::log2(steps[d]))) + more_bits;
      for (const Id id : ids_of_state(d)) {
        range = {std::min(range.low, ranges.kept[id].low), std::max(range.high, ranges.kept[id].high)};
        if (plan_.graph[id].op == Op::kInput && plan_.graph[id].role == Role::kState)
          fraction = std::max(fraction, fraction_of(id, more_bits));
      }
      range.low = std::min(range.low, -0x1p-30);  // a sign always
      const Format format = graph::format_for(range, fraction, kMostBits);
      all.states.push_back({true, format.integer, format.fraction});
      width = std::max(width, format.width());
    }
    for (std::size_t d = 0; d < dims; ++d) {
      all.states[d].fraction += width - all.states[d].width();
      for (const Id id : ids_of_state(d))
        if (!keeps_its_format(id, d, all.states[d])) all.formats[id] = all.states[d];
    }
  }

  /// Whether what goes out as state d is converted only there: a constant, another state's parent that is handed on, a
  /// function that no table is exact enough to.
  bool keeps_its_format(Id id, std::size_t d, const Format& state) const {
    const Vertex& v = plan_.graph[id];
    const bool other = v.op == Op::kInput && (v.role == Role::kState || v.role == Role::kBefore) && v.index != d;
    return plan_.graph.is_constant(id) || other || (is_function(v.op) && beyond_tables(v.op, state) > 0);
  }

  /// Where a state comes in and goes out.
  std::vector<Id> ids_of_state(std::size_t d) const {
    std::vector<Id> all{plan_.initial[d], plan_.next[d]};
    for (Id id = 0; id < plan_.graph.size(); ++id) {
      const Vertex& v = plan_.graph[id];
      if (v.op == Op::kInput && (v.role == Role::kState || v.role == Role::kBefore) && v.index == d) all.push_back(id);
    }
    return all;
  }

  const Plan& plan_;
  const graph::Recorded& recorded_;
  const Samples& samples_;
  std::vector<Interval> seen_;
  std::vector<double> need_;
};

}  // namespace

Precision precision_of(const Plan& plan, const graph::Recorded& recorded, const Samples& samples, double margin,
                       int more_bits) {
  Precision all = Analysis(plan, recorded, samples).precision(margin, more_bits);
  if (all.states[0].width() <= kWideState + more_bits) return all;
  return Analysis(plan, recorded, within_reach(plan, recorded, samples)).precision(margin, more_bits);
}

}  // namespace mote::hardware
