#include "mote/hardware/datapath/mapping.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mote::hardware {
namespace {

using graph::Id;
using graph::Op;
using graph::Vertex;

/// Shifts and additions take over from a multiplier up to so many digits of the constant.
constexpr int kMostDigits = 6;
/// Bits of a function's operand, at least.
constexpr int kLeastOperand = 5;
/// Bits of a factor that any DSP block takes.
constexpr int kBitsOfFactor = 18;
/// Bits that parts of a sum keep beyond its last.
constexpr int kSumGuard = 2;

bool is_sum(Op op) { return op == Op::kAdd || op == Op::kSubtract; }

/// A part of a sum.
struct Addend {
  Signal signal;
  bool negative;
  int ready;
};

/// The two parts as one: the positive one first, so that a sum with a positive part is one at last.
Addend added(Sketch& sketch, Addend a, Addend b, const Format& y) {
  if (a.negative && !b.negative) std::swap(a, b);
  const bool subtract = a.negative != b.negative;
  const Signal both = subtract ? sketch.difference(a.signal, b.signal, y) : sketch.sum(a.signal, b.signal, y);
  return {both, a.negative, sketch.ready(both)};
}

/// A format for a + b or a - b that is exact but for what lies below `fraction`.
Format format_of_part(const Addend& a, const Addend& b, int fraction) {
  const Format& one = a.signal.format;
  const Format& other = b.signal.format;
  const bool sign = one.sign || other.sign || a.negative != b.negative;
  const int integer = std::max(one.integer, other.integer) + 1;
  return {sign, integer, std::max(1 - integer, std::min(fraction, std::max(one.fraction, other.fraction)))};
}

}  // namespace

void Mapping::give(Id id, const Signal& signal) { signals_[id] = converted(signal, precision_.formats[id]); }

void Mapping::compute(const std::vector<Id>& outputs) {
  wanted_.assign(plan_.graph.size(), false);
  for (const Id id : outputs) wanted_[id] = true;
  for (Id id = static_cast<Id>(wanted_.size()); id-- > 0;)
    if (wanted_[id] && !signals_.contains(id))
      for (const Id arg : operands(id)) wanted_[arg] = true;
  for (Id id = 0; id < wanted_.size(); ++id)
    if (wanted_[id] && !signals_.contains(id)) signals_[id] = made(id);
}

/// Whether a sum is a part of its only reader's.
bool Mapping::within_sum(Id id) const {
  return is_sum(plan_.graph[id].op) && readers_[id] == 1 && !signals_.contains(id) && !fused_.contains(id);
}

/// What is added or subtracted by a sum and the sums within it.
std::vector<Mapping::Term> Mapping::terms(Id sum) const {
  std::vector<Term> all;
  std::vector<Term> open{{sum, false}};
  while (!open.empty()) {
    const Term at = open.back();
    open.pop_back();
    if (at.id != sum && !within_sum(at.id)) {
      all.push_back(at);
      continue;
    }
    const Vertex& v = plan_.graph[at.id];
    open.push_back({v.args[1], at.negative != (v.op == Op::kSubtract)});
    open.push_back({v.args[0], at.negative});
  }
  return all;
}

/// What is needed for a vertex.
std::vector<Id> Mapping::operands(Id id) const {
  if (const auto found = fused_.find(id); found != fused_.end()) return {found->second.source};
  const auto direct = plan_.graph[id].operands();
  if (!is_sum(plan_.graph[id].op)) return {direct.begin(), direct.end()};
  std::vector<Id> all;
  for (const Term& term : terms(id)) all.push_back(term.id);
  return all;
}

/// The format of a sum or product, with up to `more` bits before the point in place of saturation and kSumGuard behind
/// it in place of rounding, if that makes it whole: either takes more than the bits.
Format Mapping::roomy(Id id, int integer, int fraction, int more) const {
  const Format& y = precision_.formats[id];
  const Format wide{y.sign, integer <= y.integer + more ? integer : y.integer,
                    fraction <= y.fraction + kSumGuard ? fraction : y.fraction};
  const bool log_weight = id == plan_.log_weight;
  const bool fits = !log_weight || (wide.integer <= kLogWeight.integer && wide.fraction <= kLogWeight.fraction);
  return fits && wide.width() <= room_[id] ? wide : y;
}

/// Sums and masked terms take any format, products what a DSP block takes; all else reads the vertex's own.
std::vector<int> Mapping::room_of(const Plan& plan, const std::map<Id, Fused>& fused) {
  constexpr int kMostBits = 48;
  std::vector<int> room(plan.graph.size(), kMostBits);
  for (const Part part : {Part::kInitial, Part::kNext})
    for (const Id id : plan.outputs(part)) room[id] = 0;
  for (Id id = 0; id < plan.graph.size(); ++id) {
    const Vertex& v = plan.graph[id];
    const bool masks = v.op == Op::kSelect && plan.seen_bit(v.args[0]) >= 0 && id != plan.log_weight;
    const int most = is_sum(v.op) || masks ? kMostBits : v.op == Op::kMultiply ? kBitsOfFactor : 0;
    for (const Id arg : v.operands()) room[arg] = std::min(room[arg], most);
  }
  for (const auto& [root, one] : fused) room[one.source] = 0;
  return room;
}

std::vector<unsigned> Mapping::readers_of(const Plan& plan) {
  std::vector<unsigned> readers(plan.graph.size());
  std::vector<bool> seen(plan.graph.size());
  for (const Part part : kParts) {
    const std::vector<Id> outputs = plan.outputs(part);
    for (const Id id : outputs) ++readers[id];
    for (const Id id : needed(plan.graph, outputs)) {
      if (seen[id]) continue;
      seen[id] = true;
      for (const Id arg : plan.graph[id].operands()) ++readers[arg];
    }
  }
  return readers;
}

Signal Mapping::in(Id id, const Format& format) { return converted(signal(id), format); }

Signal Mapping::made(Id id) {
  const Vertex& v = plan_.graph[id];
  const Format& y = precision_.formats[id];
  if (fused_.contains(id)) return tabulated(id);
  switch (v.op) {
    case Op::kConstant:
      return sketch_.constant(y, v.value);
    case Op::kAdd:
    case Op::kSubtract:
      return sum(id);
    case Op::kMultiply:
      return product(id);
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

Signal Mapping::tabulated(Id id) {
  const Fused& one = fused_.at(id);
  const Format& y = precision_.formats[id];
  const auto partner = partner_of(id);
  if (const Piecewise* unit = one.unit.piecewise()) return sketch_.polynomial(*unit, signal(one.source));
  if (!partner) return sketch_.op(one.unit, y, signal(one.source));
  const LookupPair both{*one.unit.lookup()};
  const Signal first = sketch_.op(both, y, signal(one.source), signal(fused_.at(*partner).source));
  signals_[*partner] = {{first.wire.node, 1}, y};
  return first;
}

/// A later vertex that can be read from the same block of memory at the same time.
std::optional<Id> Mapping::partner_of(Id id) const {
  const Fused& one = fused_.at(id);
  const Lookup* table = one.unit.lookup();
  if (table == nullptr || !table->in_block()) return {};
  for (const auto& [other, two] : fused_)
    if (other > id && wanted_[other] && !signals_.contains(other) && signals_.contains(two.source) &&
        sketch_.ready(signal(two.source)) == sketch_.ready(signal(one.source)) && two.unit.lookup() != nullptr &&
        *two.unit.lookup() == *table)
      return other;
  return {};
}

Signal Mapping::sum(Id id) {
  const Format& y = precision_.formats[id];
  std::vector<Addend> parts;
  for (const Term& term : terms(id)) {
    const Signal part = signal(term.id);
    parts.push_back({part, term.negative, sketch_.ready(part)});
  }
  while (parts.size() > 1) {
    std::stable_sort(parts.begin(), parts.end(), [](const Addend& a, const Addend& b) { return a.ready > b.ready; });
    const Addend first = parts.back();
    parts.pop_back();
    const Addend second = parts.back();
    const bool last = parts.size() == 1;
    const Format whole = format_of_part(first, second, y.fraction + kSumGuard);
    parts.back() = added(sketch_, first, second, last ? roomy(id, whole.integer, whole.fraction, 1) : whole);
  }
  return parts.front().signal;
}

Signal Mapping::product(Id id) {
  const Vertex& v = plan_.graph[id];
  const Format& y = precision_.formats[id];
  for (const std::size_t k : {0U, 1U})
    if (plan_.graph.is_constant(v.args[k])) return by_constant(signal(v.args[1 - k]), v.args[k], y);
  const Signal a = signal(v.args[0]);
  const Signal b = signal(v.args[1]);
  const bool both_signed = a.format.sign && b.format.sign;
  const Format whole = roomy(id, a.format.integer + b.format.integer + (both_signed ? 1 : 0), y.fraction, 3);
  const bool swapped = a.format.width() < b.format.width();  // the wider operand first, as DSP blocks have them
  return swapped ? sketch_.product(b, a, whole) : sketch_.product(a, b, whole);
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
  if (plan_.seen_bit(v.args[0]) >= 0) {
    const Signal term = signal(v.args[3]);
    // A bit that goes along comes out of a shift register, too late for more than the choice.
    return sketch_.select(signal(v.args[0]), term, sketch_.constant(term.format, 0), overlapped_);
  }
  const Signal a = converted(signal(v.args[2]), y);
  const Signal b = converted(signal(v.args[3]), y);
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
    case Op::kTan: {
      const Format wide{true, std::max(1, y.integer), std::max(2, y.fraction)};
      return converted(unary("tan ", operand(v.args[0]), wide, tangent), y);
    }
    case Op::kAtan:
    case Op::kAtan2:
      return angle(v, y);
    default:  // inputs were given
      throw std::logic_error("no circuit for the operation " + std::string(name_of(v.op)));
  }
}

}  // namespace mote::hardware
