#include "mote/engine/estimand.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/ungm.hpp"

namespace mote {
namespace {

using Kind = Estimand::Kind;

const std::vector<ValueSource>& sources() {
  static const std::vector<ValueSource> all = value_sources(Bearings{});
  return all;
}
Estimand parsed(const std::string& text) { return parse_estimand(text, sources(), "mote run"); }

TEST(Estimand, SourcesAreStatesThenFunctions) {
  std::vector<std::string> names;
  for (const auto& source : sources()) names.push_back(source.quantity.name);
  EXPECT_EQ(names, (std::vector<std::string>{"x", "vx", "y", "vy", "speed", "course", "range", "azimuth"}));
  EXPECT_TRUE(sources()[5].quantity.angle);
  EXPECT_EQ(value_sources(Ungm<1>{}).size(), 1U) << "a model without functions has its states";
}

TEST(Estimand, ReadsEveryForm) {
  const auto is = [](const std::string& text, Kind kind, double argument, std::size_t source) {
    const Estimand e = parsed(text);
    EXPECT_EQ(e.label, text);
    EXPECT_EQ(e.kind, kind) << text;
    EXPECT_DOUBLE_EQ(e.argument, argument) << text;
    EXPECT_EQ(e.source, source) << text;
  };
  is("vx", Kind::kMean, 0, 1);
  is("mean(speed)", Kind::kMean, 0, 4);
  is("sd(y)", Kind::kSd, 0, 2);
  is("median(range)", Kind::kQuantile, 0.5, 6);
  is("q0.9(x)", Kind::kQuantile, 0.9, 0);
  is("q0(x)", Kind::kQuantile, 0, 0);
  is("q1(x)", Kind::kQuantile, 1, 0);
  is("P(speed>1.5)", Kind::kAbove, 1.5, 4);
  is("P(course<-0.5)", Kind::kBelow, -0.5, 5);
  is("P(x>1e-3)", Kind::kAbove, 1e-3, 0);
}

TEST(Estimand, RefusesWhatItCannotRead) {
  for (const char* text : {"",        "z",        "(",        ")",        "x)",         "mean(x", "mean()",
                           "mode(x)", "q(x)",     "q1.5(x)",  "q-0.1(x)", "qnan(x)",    "q0.9",   "P(x)",
                           "P(x>)",   "P(x>one)", "P(x>nan)", "P(>1)",    "P(x>1,y>1)", "sd(z)",  "mean(x)mean(y)"}) {
    try {
      parsed(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kWrongUse);
      EXPECT_NE(std::string(refusal.what()).find("--estimate"), std::string::npos);
      EXPECT_NE(std::string(refusal.what()).find("azimuth"), std::string::npos) << "names what there is";
    }
  }
}

TEST(Estimand, EvaluatesOnAWeightedSet) {
  Particles<double> x(4, 3);
  const std::array<double, 4> slow{3, 0.3, 4, 0.4};  // speed 0.5, range 5
  const std::array<double, 4> fast{6, -3, 8, -4};    // speed 5, range 10
  const std::array<double, 4> ignored{kNaN, kNaN, 0, 0};
  x.write(0, slow);
  x.write(1, fast);
  x.write(2, ignored);
  const std::vector<double> weights{3, 1, 0};
  const WeightedSet set{&x, weights, 4};
  std::vector<double> scratch;
  const auto value = [&](const std::string& text) {
    const Estimand e = parsed(text);
    return evaluate(e, sources()[e.source], set, scratch);
  };
  EXPECT_DOUBLE_EQ(value("range"), (3 * 5 + 10) / 4.0);
  EXPECT_DOUBLE_EQ(value("sd(range)"), std::sqrt((3 * 1.25 * 1.25 + 3.75 * 3.75) / 4));
  EXPECT_DOUBLE_EQ(value("median(speed)"), 0.5);
  EXPECT_DOUBLE_EQ(value("q0.8(speed)"), 5);
  EXPECT_DOUBLE_EQ(value("P(range>7)"), 0.25);
  EXPECT_DOUBLE_EQ(value("P(range<7)"), 0.75);
  EXPECT_NEAR(value("azimuth"), std::atan2(4, 3), 1e-12);
}

TEST(Estimand, ReadsFloatParticlesToo) {
  Particles<float> x(1, 2);
  x.component(0)[0] = 1;
  x.component(0)[1] = 2;
  const std::vector<double> weights{1, 1};
  std::vector<double> scratch;
  const auto all = value_sources(Ungm<1>{});
  EXPECT_DOUBLE_EQ(evaluate(parse_estimand("x", all, ""), all[0], {&x, weights, 2}, scratch), 1.5);
}

}  // namespace
}  // namespace mote
