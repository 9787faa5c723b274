#include "mote/graph/text/expression.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"

namespace mote::graph {
namespace {

/// An expression of x = 3 and y = -0.5, as constants.
double value_of(const std::string& text) {
  const Node node = parse_expression({"m.toml", 7, "x", text}, Vocabulary{{{"x", Node(3)}, {"y", Node(-0.5)}}, {}, {}});
  return node.constant();
}

std::string refusal_of(const std::string& text) {
  const Vocabulary vocabulary{{{"x", Node(3)}}, {{"u", "u is for [next]."}}, {}};
  try {
    parse_expression({"m.toml", 7, "x", text}, vocabulary);
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kBadData);
    return refusal.what();
  }
  return "accepted";
}

TEST(Expression, BindsAsInMathematics) {
  EXPECT_EQ(value_of("1 + 2*x"), 7);
  EXPECT_EQ(value_of("(1 + 2)*x"), 9);
  EXPECT_EQ(value_of("10 - 4 - 3"), 3);
  EXPECT_EQ(value_of("12/3/2"), 2);
  EXPECT_EQ(value_of("-x^2"), -9);
  EXPECT_EQ(value_of("2^-1"), 0.5);
  EXPECT_EQ(value_of("2^3^2"), 512);
  EXPECT_EQ(value_of("2*-x"), -6);
  EXPECT_EQ(value_of("- - + x"), 3);
  EXPECT_EQ(value_of(".5e1 + 1."), 6);
  EXPECT_EQ(value_of("\n 1 +\n 2"), 3);
}

TEST(Expression, HasItsFunctionsAndConstants) {
  EXPECT_EQ(value_of("sqrt(x)"), std::sqrt(3.0));
  EXPECT_EQ(value_of("exp(y)*log(x)"), std::exp(-0.5) * std::log(3.0));
  EXPECT_EQ(value_of("sin(x) + cos(x) + tan(x)"), std::sin(3.0) + std::cos(3.0) + std::tan(3.0));
  EXPECT_EQ(value_of("atan(x) - atan2(y, x)"), std::atan(3.0) - std::atan2(-0.5, 3.0));
  EXPECT_EQ(value_of("abs(y) + min(x, y) - max(x, y)"), 0.5 - 0.5 - 3);
  EXPECT_EQ(value_of("wrap(3*pi/2)"), numbers::wrap(3 * kPi / 2));
  EXPECT_EQ(value_of("e"), std::numbers::e);
}

TEST(Expression, RaisesToWholePowersByProducts) {
  EXPECT_EQ(value_of("y^3"), -0.125);
  EXPECT_EQ(value_of("x^5"), 243);
  EXPECT_EQ(value_of("y^-2"), 4);
  EXPECT_EQ(value_of("y^0"), 1);
  EXPECT_EQ(value_of("x^0.5"), std::sqrt(3.0));
  EXPECT_EQ(value_of("x^2.5"), std::exp(2.5 * std::log(3.0)));
}

TEST(Expression, DrawsInTheOrderOfTheText) {
  Graph graph;
  std::vector<bool> taken;
  const Vocabulary vocabulary{{}, {}, [&](bool normal) {
                                taken.push_back(normal);
                                return Node(graph,
                                            graph.input(Role::kNormal, static_cast<std::uint32_t>(taken.size())));
                              }};
  parse_expression({"m.toml", 1, "x", "normal(0, 2) + uniform(-1, normal(1, 1))"}, vocabulary);
  EXPECT_EQ(taken, (std::vector<bool>{true, true, false}));
}

TEST(Expression, RefusesByFileLineAndToken) {
  EXPECT_EQ(refusal_of("1 + cosx(2)"),
            "m.toml:7: x: expected a function, got \"cosx\". Functions are sqrt, exp, log, sin, cos, tan, atan, atan2, "
            "abs, min, max, wrap, normal and uniform.");
  EXPECT_NE(refusal_of("1 +\n z").find("m.toml:8: x: expected one of x, pi, e, got \"z\"."), std::string::npos);
  EXPECT_NE(refusal_of("u").find("got \"u\". u is for [next]."), std::string::npos);
  EXPECT_NE(refusal_of("2x").find("expected an operator or the end, got \"x\"."), std::string::npos);
  EXPECT_NE(refusal_of("(1").find("expected \")\", got the end."), std::string::npos);
  EXPECT_NE(refusal_of("1 % 2").find("got \"%\"."), std::string::npos);
  EXPECT_NE(refusal_of("1e999").find("expected a number, got \"1e999\"."), std::string::npos);
  EXPECT_NE(refusal_of("").find("got the end."), std::string::npos);
  EXPECT_NE(refusal_of("sqrt(1, 2)").find("x: \"sqrt\": expected one argument, got 2."), std::string::npos);
  EXPECT_NE(refusal_of("sin").find("expected a function with its arguments in brackets"), std::string::npos);
  EXPECT_NE(refusal_of("normal(0, 1)").find("expected an expression without draws"), std::string::npos);
  EXPECT_NE(refusal_of("angle(0, 1)").find("expected angle(mean, sd) as the whole law"), std::string::npos);
  EXPECT_NE(refusal_of("1/0").find("expected a finite number, got inf."), std::string::npos);
  EXPECT_NE(refusal_of(std::string(300, '(')).find("at most 200 levels"), std::string::npos);
  std::string tower = "x";
  for (int k = 0; k < 300; ++k) tower += "^x";
  EXPECT_NE(refusal_of(tower).find("at most 200 levels"), std::string::npos);
}

TEST(Law, IsOneCallOfNormalOrAngle) {
  const Vocabulary vocabulary{{{"x", Node(3)}}, {}, {}};
  const auto law = [&](const std::string& text) { return parse_law({"m.toml", 7, "y", text}, vocabulary); };
  EXPECT_FALSE(law("normal((x), 2)").angle);
  EXPECT_TRUE(law("angle(x, sqrt(2))").angle);
  EXPECT_EQ(law("normal(x + 1, 2)").mean.constant(), 4);
  EXPECT_THROW(law("normal(x, 1) + 2"), Refusal);
  EXPECT_THROW(law("x"), Refusal);
  EXPECT_THROW(law("normal(x)"), Refusal);
  EXPECT_THROW(law("normal(x, 0)"), Refusal);
  EXPECT_THROW(law("normal(x, 1"), Refusal);
}

TEST(MaybeWrapped, KnowsAWrapAroundAll) {
  const Vocabulary vocabulary{{{"x", Node(3)}}, {}, {}};
  const auto parsed = [&](const std::string& text) {
    return parse_maybe_wrapped({"m.toml", 7, "x", text}, vocabulary);
  };
  EXPECT_TRUE(parsed("wrap(x + 4)").wrapped);
  EXPECT_EQ(parsed("wrap(x + 4)").inner.constant(), 7);
  EXPECT_FALSE(parsed("wrap(x) + wrap(4)").wrapped);
}

TEST(FreeName, IsNoWordOfTheLanguage) {
  for (const char* name : {"x", "_v1", "Sigma_u"}) EXPECT_TRUE(is_free_name(name)) << name;
  for (const char* name : {"", "1x", "a b", "t", "e", "pi", "exp", "normal", "log_likelihood"})
    EXPECT_FALSE(is_free_name(name)) << name;
}

}  // namespace
}  // namespace mote::graph
