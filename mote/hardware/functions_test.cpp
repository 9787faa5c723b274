#include "mote/hardware/functions.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/base/draws.hpp"
#include "mote/base/numbers.hpp"
#include "mote/hardware/bench_laws.hpp"

namespace mote::hardware {
namespace {

using Referee = std::function<double(double, double)>;

struct Case {
  std::string name;
  Compound op;
  std::vector<Format> in;
  Format out;
  std::vector<Referee> wanted;  // one an output
};

double positive(double x, const Format& format) { return x == 0 ? format.step() : x; }

/// Every function in one form, on formats of so many bits for operands and results.
std::vector<Case> cases(const FunctionOptions& how, int bits) {
  const int f = bits - 5;
  const Format wide{true, 4, f};
  const Format plain{false, 4, f + 1};
  const Format unit{true, 1, f};
  const Format logs{true, 4, f};
  const auto one = [](double (*function)(double)) { return [function](double x, double) { return function(x); }; };
  return {{"1/x", reciprocal(wide, {true, 5, f - 2}, how), {wide}, {true, 5, f - 2}, {[wide](double x, double) {
             return 1 / positive(x, wide);
           }}},
          {"a/b",
           divide(wide, plain, {true, 6, f - 2}, how),
           {wide, plain},
           {true, 6, f - 2},
           {[plain](double a, double b) { return a / positive(b, plain); }}},
          {"sqrt", square_root(plain, {false, 2, f}, how), {plain}, {false, 2, f}, {one(std::sqrt)}},
          {"log", logarithm(plain, logs, how), {plain}, logs, {[plain](double x, double) {
             return std::log(positive(x, plain));
           }}},
          {"exp", exponential(wide, {false, 4, f}, how), {wide}, {false, 4, f}, {one(std::exp)}},
          {"cos, sin", cosine_and_sine(wide, unit, how), {wide}, unit, {one(std::cos), one(std::sin)}},
          {"tan", tangent(wide, {true, 4, f - 1}, how), {wide}, {true, 4, f - 1}, {one(std::tan)}},
          {"atan2", arc_tangent_2(wide, f, how), {wide, wide}, {true, 2, f}, {[](double b, double a) {
             return std::atan2(b, a);
           }}},
          {"atan", arc_tangent(wide, f, how), {wide}, unit, {one(std::atan)}}};
}

constexpr FunctionOptions kForms[] = {{Form::kTable}, {Form::kCordic}};

/// The greatest error in steps of the result's format over some rows of operands, where the result is in range or
/// saturates.
double worst_of(const Case& one, const Table& inputs) {
  const std::size_t rows = inputs[0].size();
  const Table outputs = computed(one.op, inputs, rows);
  double worst = 0;
  for (std::size_t o = 0; o < outputs.size(); ++o)
    for (std::size_t row = 0; row < rows; ++row) {
      const double b = one.in.size() > 1 ? one.in[1].value(inputs[1][row]) : 0;
      double want = one.wanted[o](one.in[0].value(inputs[0][row]), b);
      // a magnitude saturates before it gets its sign, so the least number of all does not come
      const double most = one.out.value(one.out.greatest());
      want = std::clamp(want, one.out.sign ? -most : 0, most);
      worst = std::max(worst, std::abs(one.out.value(outputs[o][row]) - want) / one.out.step());
    }
  return worst;
}

// claim    every function of one number is within a step of the truth on every number of 17-bit formats, in both forms
// referee  the C library in double
TEST(Functions, OfOneNumberAreWithinAStepOnAllNumbers) {
  for (const FunctionOptions& how : kForms)
    for (const Case& one : cases(how, 16)) {
      if (one.in.size() > 1) continue;
      Table all(1);
      for (Word x = one.in[0].least(); x <= one.in[0].greatest(); ++x) all[0].push_back(x);
      EXPECT_LT(worst_of(one, all), 1.0) << one.name << (how.form == Form::kTable ? ", table" : ", CORDIC");
    }
}

// claim    every function of two numbers is within a step on all pairs of 9-bit formats
TEST(Functions, OfTwoNumbersAreWithinAStepOnAllPairs) {
  for (const FunctionOptions& how : kForms)
    for (const Case& one : cases(how, 9)) {
      if (one.in.size() < 2) continue;
      Table all(2);
      for (Word a = one.in[0].least(); a <= one.in[0].greatest(); ++a)
        for (Word b = one.in[1].least(); b <= one.in[1].greatest(); ++b) {
          all[0].push_back(a);
          all[1].push_back(b);
        }
      EXPECT_LT(worst_of(one, all), 1.0) << one.name << (how.form == Form::kTable ? ", table" : ", CORDIC");
    }
}

TEST(Functions, AnglesWrapToTheOneClosestToZero) {
  const Format x{true, 6, 12};
  const Compound wrap = wrapped_angle(x);
  Table all(1);
  for (Word word = x.least(); word <= x.greatest(); ++word) all[0].push_back(word);
  const Table out = computed(wrap, all, all[0].size());
  for (std::size_t i = 0; i < all[0].size(); ++i) {
    const double angle = std::ldexp(static_cast<double>(out[0][i]), -12);
    ASSERT_LE(std::abs(angle), kPi + 0x1p-12);
    ASSERT_LT(std::abs(std::remainder(angle - x.value(all[0][i]), 2 * kPi)), 0x1p-12);
  }
}

TEST(Functions, CircuitsEqualTheirTwins) {
  Lockstep all;
  for (const FunctionOptions& how :
       {FunctionOptions{Form::kTable}, {Form::kCordic}, {Form::kTable, Multiplier::kLogic}})
    for (const Case& one : cases(how, 16)) all.add(one.op);
  all.add(wrapped_angle({true, 6, 12}));
  all.expect_agreement(1'000'000);
}

}  // namespace
}  // namespace mote::hardware
