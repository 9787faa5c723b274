#include "mote/graph/interval.hpp"

#include <algorithm>
#include <cmath>

namespace mote::graph {
namespace {

constexpr Interval kAll{};

/// x y with 0 times infinity zero: a bound of zero is never left.
double times(double x, double y) { return x == 0 || y == 0 ? 0 : x * y; }

Interval hull(std::initializer_list<double> values) {
  const auto [low, high] = std::minmax(values);
  return {low, high};
}

Interval product(const Interval& a, const Interval& b) {
  return hull({times(a.low, b.low), times(a.low, b.high), times(a.high, b.low), times(a.high, b.high)});
}

Interval inverse(const Interval& a) {
  if (a.contains(0)) return kAll;
  return {1 / a.high, 1 / a.low};
}

Interval absolute(const Interval& a) {
  const double most = std::max(std::abs(a.low), std::abs(a.high));
  return {a.contains(0) ? 0 : std::min(std::abs(a.low), std::abs(a.high)), most};
}

Interval square(const Interval& a) {
  const Interval size = absolute(a);
  return {size.low * size.low, size.high * size.high};
}

/// f of an interval on which it never falls; below `from` it has no values.
Interval rising(const Interval& a, double (*f)(double), double from = -kInfinity) {
  return {f(std::max(a.low, from)), f(std::max(a.high, from))};
}

Interval sine(const Interval& a) {
  if (!(a.high - a.low < 2 * kPi)) return {-1, 1};
  // a crest is at pi/2 + 2 pi k, a trough half a turn later
  const auto has = [&](double phase) {
    return std::floor((a.high - phase) / (2 * kPi)) > std::floor((a.low - phase) / (2 * kPi));
  };
  return {has(-kPi / 2) ? -1 : std::min(std::sin(a.low), std::sin(a.high)),
          has(kPi / 2) ? 1 : std::max(std::sin(a.low), std::sin(a.high))};
}

Interval tangent(const Interval& a) {
  const double turn = std::floor(a.low / kPi + 0.5);
  if (!(a.high < (turn + 0.5) * kPi)) return kAll;
  return {std::tan(a.low), std::tan(a.high)};
}

Interval direction(const Interval& y, const Interval& x) {
  if (x.low <= 0) return {-kPi, kPi};
  return hull(
      {std::atan2(y.low, x.low), std::atan2(y.low, x.high), std::atan2(y.high, x.low), std::atan2(y.high, x.high)});
}

Interval chosen(const Interval& a, const Interval& b, const Interval& c, const Interval& d) {
  if (a.high < b.low) return c;
  if (a.low >= b.high) return d;
  return {std::min(c.low, d.low), std::max(c.high, d.high)};
}

Interval of(Op op, const std::array<Interval, 4>& v) {
  const Interval& a = v[0];
  const Interval& b = v[1];
  switch (op) {
    case Op::kAdd:
      return {a.low + b.low, a.high + b.high};
    case Op::kSubtract:
      return {a.low - b.high, a.high - b.low};
    case Op::kMultiply:
      return product(a, b);
    case Op::kDivide:
      return product(a, inverse(b));
    case Op::kNegate:
      return {-a.high, -a.low};
    case Op::kAbs:
      return absolute(a);
    case Op::kFloor:
      return rising(a, std::floor);
    case Op::kSqrt:
      return rising(a, std::sqrt, 0);
    case Op::kExp:
      return rising(a, std::exp);
    case Op::kLog:
      return rising(a, std::log, 0);
    case Op::kSin:
      return sine(a);
    case Op::kCos:
      return sine({a.low + kPi / 2, a.high + kPi / 2});
    case Op::kTan:
      return tangent(a);
    case Op::kAtan:
      return rising(a, std::atan);
    case Op::kAtan2:
      return direction(a, b);
    case Op::kSelect:
      return chosen(a, b, v[2], v[3]);
    case Op::kConstant:
    case Op::kInput:
      break;
  }
  return kAll;
}

/// Infinity minus infinity, and the like, says nothing.
Interval sound(const Interval& a) {
  return {std::isnan(a.low) ? -kInfinity : a.low, std::isnan(a.high) ? kInfinity : a.high};
}

}  // namespace

Interval intersection(const Interval& a, const Interval& b) {
  const Interval both{std::max(a.low, b.low), std::min(a.high, b.high)};
  return both.low <= both.high ? both : a;
}

std::vector<Interval> intervals(const Graph& graph, const std::function<Interval(const Vertex&)>& input) {
  std::vector<Interval> all;
  for (const Vertex& v : graph.vertices()) {
    if (v.op == Op::kConstant) {
      all.push_back({v.value, v.value});
    } else if (v.op == Op::kInput) {
      all.push_back(input(v));
    } else if (v.op == Op::kMultiply && v.args[0] == v.args[1]) {
      all.push_back(square(all[v.args[0]]));
    } else {
      std::array<Interval, 4> args{};
      for (std::size_t k = 0; k < arity(v.op); ++k) args[k] = all[v.args[k]];
      all.push_back(sound(of(v.op, args)));
    }
  }
  return all;
}

}  // namespace mote::graph
