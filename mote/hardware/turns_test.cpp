#include "mote/hardware/turns.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "mote/hardware/bench_laws.hpp"
#include "mote/hardware/functions.hpp"
#include "mote/hardware/lookup.hpp"
#include "mote/hardware/sketch.hpp"

namespace mote::hardware {
namespace {

constexpr Format kPlain{true, 3, 8};
constexpr Format kShort{true, 2, 6};
constexpr Format kBare{false, 4, 5};

/// Products of several formats, rounded, cut and saturated, two readings of one table, and functions with products
/// within: what takes turns in as many ways as there are.
Compound mixed(Multiplier multiplier, int interval) {
  Sketch s("mixed_" + std::to_string(interval) + (multiplier == Multiplier::kLogic ? "_logic" : ""), multiplier,
           interval);
  const Signal a = s.input("a_i", kPlain);
  const Signal b = s.input("b_i", kShort);
  const Signal c = s.input("c_i", kBare);
  const FunctionOptions options{Form::kTable, multiplier, interval};
  const Lookup table([](double x) { return x * x * x; }, kShort, {true, 6, 12});
  const Signal ab = s.product(a, b, {true, 3, 9});
  const Signal abc = s.product(ab, c, {true, 6, 4});
  const Signal cubes = s.sum(s.op(table, table.y(), b), s.op(table, table.y(), s.convert(ab, kShort)), {true, 7, 12});
  const Signal ratio = s.op(divide(kPlain, kBare, {true, 4, 10}, options), {true, 4, 10}, a, c);
  const Signal root = s.op(square_root(kBare, {false, 3, 9}, options), {false, 3, 9}, c);
  const Signal cosine = s.op(cosine_and_sine(kPlain, {true, 1, 10}, options), {true, 1, 10}, a);
  const Signal sine{{cosine.wire.node, 1}, {true, 1, 10}};
  s.output("y0_o", abc);
  s.output("y1_o", s.product(cosine, sine, {true, 1, 20}));
  s.output("y2_o", s.sum(cubes, s.product(ratio, root, {true, 8, 8}), {true, 9, 8}));
  return s.done();
}

/// How often a text has a word.
std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// claim   a pipeline whose operators take turns gives its twin's words, a row every k clocks, whatever comes between,
// and
//         the twin's words do not depend on k
// referee the same pipeline without turns
TEST(Turns, ChangeNoWord) {
  Lockstep all;
  for (const Multiplier multiplier : {Multiplier::kDsp, Multiplier::kLogic})
    for (const int interval : {2, 3, 7})
      if (multiplier == Multiplier::kDsp || interval == 3) all.add(mixed(multiplier, interval));
  all.expect_agreement(10000);
  const Compound apart = mixed(Multiplier::kDsp, 1);
  const Compound taken = mixed(Multiplier::kDsp, 4);
  const Table rows{{-900, 0, 17, 2047}, {255, -256, 3, -9}, {511, 0, 1, 77}};
  EXPECT_EQ(computed(apart, rows, 4), computed(taken, rows, 4));
}

// The twin: a circuit of another interval than it says.
struct Hurried {
  Compound compound;
  void compute(Columns in, Results out) const { compound.compute(in, out); }
  Circuit circuit() const {
    Circuit wrong = compound.circuit();
    --wrong.interval;
    return wrong;
  }
};
TEST(Turns, AreCaughtWhereRowsComeTooSoon) {
  Sketch s("cube", Multiplier::kDsp, 3);
  const Signal a = s.input("a_i", kShort);
  s.output("y_o", s.product(s.product(a, a, kPlain), a, kPlain));
  Lockstep wrong;
  wrong.add(Hurried{s.done()});
  EXPECT_NONFATAL_FAILURE(wrong.expect_agreement(1000), "cube");
}

// claim   m multipliers become ceil(m / k), and never wait more than k - 1 clocks for a turn
TEST(Turns, TakeAsFewInstancesAsTheyCan) {
  for (const int interval : {1, 2, 3, 5, 8}) {
    Sketch s("products", Multiplier::kDsp, interval);
    Signal sum = s.input("a_i", kPlain);
    for (int k = 0; k < 8; ++k) sum = s.product(sum, sum, kPlain);
    s.output("y_o", sum);
    const Circuit circuit = s.done().circuit();
    const std::string& text = circuit.sources.back().text;
    const auto expected = static_cast<std::size_t>((8 + interval - 1) / interval);
    EXPECT_EQ(count_of(text, interval == 1 ? "mote_multiply #" : "mote_multiply_add #"), expected) << interval;
    EXPECT_LE(circuit.latency, 8 * (3 + interval - 1) + 1) << interval;
    EXPECT_EQ(circuit.interval, interval);
  }
}

}  // namespace
}  // namespace mote::hardware
