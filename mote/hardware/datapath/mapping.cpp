#include "mote/hardware/datapath/mapping.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/refusal.hpp"

namespace mote::hardware {
namespace {

using graph::Id;
using graph::Op;
using graph::Vertex;

/// Shifts and additions take over from a multiplier up to so many digits of the constant.
constexpr int kMostDigits = 6;
/// Bits of a function's operand, at least.
constexpr int kLeastOperand = 5;

/// How a sum is finished: what cannot overflow needs no saturation, and what loses no bits no rounding.
Finish finish_of(WideWord least, WideWord greatest, int fraction, const Format& y) {
  const int drop = fraction - y.fraction;
  const auto at = [&](Word end) {
    return drop >= 0 ? static_cast<WideWord>(end) << drop : static_cast<WideWord>(end) >> -drop;
  };
  const bool fits = least >= at(y.least()) && greatest <= at(y.greatest());
  return {drop > 0 ? Rounding::kNearest : Rounding::kDown, fits ? Overflow::kWrap : Overflow::kSaturate};
}

}  // namespace

void Mapping::give(Id id, const Signal& signal) { signals_[id] = converted(signal, precision_.formats[id]); }

void Mapping::compute(const std::vector<Id>& outputs) {
  std::vector<bool> used(plan_.graph.size());
  for (const Id id : outputs) used[id] = true;
  for (Id id = static_cast<Id>(used.size()); id-- > 0;)
    if (used[id] && !signals_.contains(id)) {
      if (const auto found = fused_.find(id); found != fused_.end()) {
        used[found->second.source] = true;
        continue;
      }
      for (const Id arg : plan_.graph[id].operands()) used[arg] = true;
    }
  for (Id id = 0; id < used.size(); ++id)
    if (used[id] && !signals_.contains(id)) signals_[id] = made(id);
}

Signal Mapping::in(Id id, const Format& format) { return converted(signal(id), format); }

Signal Mapping::made(Id id) {
  const Vertex& v = plan_.graph[id];
  const Format& y = precision_.formats[id];
  if (const auto found = fused_.find(id); found != fused_.end())
    return sketch_.op(found->second.unit, y, signal(found->second.source));
  switch (v.op) {
    case Op::kConstant:
      return sketch_.constant(y, v.value);
    case Op::kAdd:
      return sum(v, y, false);
    case Op::kSubtract:
      return sum(v, y, true);
    case Op::kMultiply:
      return product(v, y);
    case Op::kNegate:
      return sketch_.difference(sketch_.constant({true, 1, 0}, 0), signal(v.args[0]), y);
    case Op::kAbs: {
      const Signal a = signal(v.args[0]);
      return converted(sketch_.magnitude(a, sketch_.sign(a)), y);
    }
    case Op::kFloor: {
      const Signal a = signal(v.args[0]);
      const Format whole{a.format.sign, std::max(a.format.integer, 1), 0};
      return converted(sketch_.convert(a, whole, {Rounding::kDown, Overflow::kSaturate}), y);
    }
    case Op::kSelect:
      return selection(v, y);
    default:
      return function(id, y);
  }
}

Signal Mapping::sum(const Vertex& v, const Format& y, bool subtract) {
  const Signal a = signal(v.args[0]);
  const Signal b = signal(v.args[1]);
  const int fraction = std::max(a.format.fraction, b.format.fraction);
  const auto at = [&](Word end, const Format& f) { return static_cast<WideWord>(end) << (fraction - f.fraction); };
  const WideWord low = at(subtract ? b.format.greatest() : b.format.least(), b.format);
  const WideWord high = at(subtract ? b.format.least() : b.format.greatest(), b.format);
  const WideWord least = at(a.format.least(), a.format) + (subtract ? -low : low);
  const WideWord greatest = at(a.format.greatest(), a.format) + (subtract ? -high : high);
  return sketch_.op(Sum{a.format, b.format, y, subtract, finish_of(least, greatest, fraction, y)}, y, a, b);
}

Signal Mapping::product(const Vertex& v, const Format& y) {
  for (const std::size_t k : {0U, 1U})
    if (plan_.graph.is_constant(v.args[k])) return by_constant(signal(v.args[1 - k]), v.args[k], y);
  const Signal a = signal(v.args[0]);
  const Signal b = signal(v.args[1]);
  const bool swapped = a.format.width() < b.format.width();  // the wider operand first, as DSP blocks have them
  return swapped ? sketch_.product(b, a, y) : sketch_.product(a, b, y);
}

Signal Mapping::by_constant(const Signal& a, Id constant, const Format& y) {
  const Signal c = signal(constant);
  const Word word = c.format.nearest(plan_.graph[constant].value);
  if (word == 0) return sketch_.constant(y, 0);
  const SignedDigits digits = signed_digits(word);
  if (digits.count() == 1 && digits.minus == 0)
    return converted(a.times_two_to(digits.width() - 1 - c.format.fraction), y);
  if (functions_.options().multiplier == Multiplier::kDsp && digits.count() > kMostDigits)
    return sketch_.product(a, c, y);
  return sketch_.op(ConstantProduct{a.format, y, word, c.format.fraction}, y, a);
}

Signal Mapping::selection(const Vertex& v, const Format& y) {
  const Signal a = converted(signal(v.args[2]), y);
  const Signal b = converted(signal(v.args[3]), y);
  if (plan_.seen_bit(v.args[0]) >= 0) return sketch_.select(signal(v.args[0]), b, a);
  return sketch_.select(sketch_.less(signal(v.args[0]), signal(v.args[1])), a, b);
}

Signal Mapping::operand(Id id) {
  const Signal a = signal(id);
  const int more = std::max(0, kLeastOperand - a.format.width());
  return converted(a, {a.format.sign, a.format.integer, a.format.fraction + more});
}

Signal Mapping::unsigned_of(const Signal& a) {
  return a.format.sign ? sketch_.convert(a, {false, a.format.integer, a.format.fraction}) : a;
}

Signal Mapping::unary(const std::string& name, const Signal& x, const Format& y,
                      Compound (*make)(const Format&, const Format&, const FunctionOptions&)) {
  const auto& unit =
      functions_.once(name + x.format.name() + " " + y.name(), [&] { return make(x.format, y, functions_.options()); });
  return sketch_.op(unit, y, x);
}

Signal Mapping::cosine_or_sine(const Vertex& v, const Format& y) {
  const Signal x = operand(v.args[0]);
  const Format unit{true, 1, std::max(2, y.fraction)};
  const std::string key = x.format.name() + " " + unit.name();
  const std::string of_this = std::to_string(v.args[0]) + " " + key;
  if (!pairs_.contains(of_this)) {
    const auto& both = functions_.once("cosine and sine " + key,
                                       [&] { return cosine_and_sine(x.format, unit, functions_.options()); });
    const Signal cosine = sketch_.op(both, unit, x);
    pairs_.insert({of_this, {cosine, {{cosine.wire.node, 1}, unit}}});
  }
  const Pair& pair = pairs_.at(of_this);
  return converted(v.op == Op::kCos ? pair.cosine : pair.sine, y);
}

Signal Mapping::angle(const Vertex& v, const Format& y) {
  const Signal b = operand(v.args[0]);
  const int fraction = std::max(2, y.fraction);
  if (v.op == Op::kAtan) {
    const auto& unit = functions_.once("atan " + b.format.name() + " " + std::to_string(fraction),
                                       [&] { return arc_tangent(b.format, fraction, functions_.options()); });
    return converted(sketch_.op(unit, {true, 1, fraction}, b), y);
  }
  const Signal a = operand(v.args[1]);
  const Format point{true, std::max(a.format.integer, b.format.integer),
                     std::max(a.format.fraction, b.format.fraction)};
  const auto& unit = functions_.once("atan2 " + point.name() + " " + std::to_string(fraction),
                                     [&] { return arc_tangent_2(point, fraction, functions_.options()); });
  return converted(sketch_.op(unit, {true, 2, fraction}, converted(b, point), converted(a, point)), y);
}

Signal Mapping::function(Id id, const Format& y) {
  const Vertex& v = plan_.graph[id];
  switch (v.op) {
    case Op::kDivide: {
      const Signal a = operand(v.args[0]);
      const Signal b = operand(v.args[1]);
      const auto& unit = functions_.once("divide " + a.format.name() + " " + b.format.name() + " " + y.name(),
                                         [&] { return divide(a.format, b.format, y, functions_.options()); });
      return sketch_.op(unit, y, a, b);
    }
    case Op::kSqrt:
      return unary("sqrt ", unsigned_of(operand(v.args[0])), y, square_root);
    case Op::kExp:
      return unary("exp ", operand(v.args[0]), y, exponential);
    case Op::kLog: {
      const Format wide{true, y.integer, y.fraction};
      return converted(unary("log ", unsigned_of(operand(v.args[0])), wide, logarithm), y);
    }
    case Op::kSin:
    case Op::kCos:
      return cosine_or_sine(v, y);
    case Op::kAtan:
    case Op::kAtan2:
      return angle(v, y);
    default:
      refuse(id);
  }
}

void Mapping::refuse(Id id) const {
  const Vertex& v = plan_.graph[id];
  const bool input = v.op == Op::kInput;
  throw Refusal(ExitCode::kWrongUse,
                {"circuit", "vertex v" + std::to_string(id), "an operation that there is a circuit for",
                 input ? recorded_.name_of(v) : std::string(graph::name_of(v.op)),
                 "Write the model with + - * / sqrt exp log sin cos atan atan2 abs floor and select."});
}

}  // namespace mote::hardware
