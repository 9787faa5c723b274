#include "mote/graph/fixed.hpp"

#include <algorithm>

#include "mote/graph/evaluate.hpp"

namespace mote::graph {
namespace {

using Raw = std::array<std::int64_t, 4>;

/// Two operands with the same fraction.
struct Aligned {
  Wide a, b;
  int fraction;
};
Aligned aligned(const FixedOperation& o, const Raw& raw) {
  const int fraction = std::max(o.in[0].fraction, o.in[1].fraction);
  return {static_cast<Wide>(raw[0]) << (fraction - o.in[0].fraction),
          static_cast<Wide>(raw[1]) << (fraction - o.in[1].fraction), fraction};
}

std::int64_t put(const FixedOperation& o, Wide raw, int fraction) { return rescaled(raw, fraction, o.out, o.rounding); }

std::int64_t add(const FixedOperation& o, const Raw& raw) {
  const Aligned both = aligned(o, raw);
  return put(o, both.a + both.b, both.fraction);
}
std::int64_t subtract(const FixedOperation& o, const Raw& raw) {
  const Aligned both = aligned(o, raw);
  return put(o, both.a - both.b, both.fraction);
}
std::int64_t multiply(const FixedOperation& o, const Raw& raw) {
  return put(o, static_cast<Wide>(raw[0]) * raw[1], o.in[0].fraction + o.in[1].fraction);
}
std::int64_t negate(const FixedOperation& o, const Raw& raw) {
  return put(o, -static_cast<Wide>(raw[0]), o.in[0].fraction);
}
std::int64_t absolute(const FixedOperation& o, const Raw& raw) {
  return put(o, raw[0] < 0 ? -static_cast<Wide>(raw[0]) : static_cast<Wide>(raw[0]), o.in[0].fraction);
}
std::int64_t whole(const FixedOperation& o, const Raw& raw) {
  return o.in[0].fraction <= 0 ? put(o, raw[0], o.in[0].fraction) : put(o, raw[0] >> std::min(o.in[0].fraction, 63), 0);
}
std::int64_t select(const FixedOperation& o, const Raw& raw) {
  const Aligned both = aligned(o, raw);
  return both.a < both.b ? put(o, raw[2], o.in[2].fraction) : put(o, raw[3], o.in[3].fraction);
}
std::int64_t by_double(const FixedOperation& o, const Raw& raw) {
  std::array<double, 4> values{};
  for (std::size_t k = 0; k < arity(o.op); ++k) values[k] = o.in[k].value(raw[k]);
  return to_fixed(apply<double>(o.op, values), o.out, o.rounding);
}

Twin twin_of(Op op) {
  switch (op) {
    case Op::kAdd:
      return add;
    case Op::kSubtract:
      return subtract;
    case Op::kMultiply:
      return multiply;
    case Op::kNegate:
      return negate;
    case Op::kAbs:
      return absolute;
    case Op::kFloor:
      return whole;
    case Op::kSelect:
      return select;
    default:
      return by_double;
  }
}

}  // namespace

const Twins& rounded_double_twins() {
  static const Twins all = [] {
    Twins twins{"correctly rounded double", {}};
    for (std::size_t op = 0; op < twins.by_op.size(); ++op) twins.by_op[op] = twin_of(static_cast<Op>(op));
    return twins;
  }();
  return all;
}

FixedArithmetic::FixedArithmetic(const Graph& graph, FixedPoint point) : point_(std::move(point)) {
  for (Id id = 0; id < graph.size(); ++id) {
    FixedOperation made{graph[id].op, point_.formats[id], {}, point_.rounding};
    for (std::size_t k = 0; k < arity(made.op); ++k) made.in[k] = point_.formats[graph[id].args[k]];
    operations_.push_back(made);
  }
}

}  // namespace mote::graph
