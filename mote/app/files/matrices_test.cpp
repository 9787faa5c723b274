#include "mote/app/files/matrices.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

const std::string kRest = "Q = [[1]]\nH = [[1]]\nR = 2\nmean = [3]\ncovariance = [[4]]\n";

std::string refusal_of(const std::string& path, const std::string& text) {
  try {
    parse_linear_gaussian(path, text);
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kBadData);
    return refusal.what();
  }
  return "";
}

TEST(ParseLinearGaussian, ReadsTomlAndJsonAlike) {
  const auto toml = parse_linear_gaussian("m.toml",
                                          "F = [[1, 2.5], [0, 1]]\nQ = [[1, 0], [0, 1]]\nH = [[1, 0]]\nR = 2\n"
                                          "m0 = [3, 4]\nP0 = [[1, 0], [0, 1]]\nstates = [\"x\", \"v\"]\n");
  const auto json =
      parse_linear_gaussian("m.json", R"({"F": [[1, 2.5], [0, 1]], "Q": [[1, 0], [0, 1]], "H": [[1, 0]], "R": [[2]],
                    "mean": [3, 4], "covariance": [[1, 0], [0, 1]], "states": ["x", "v"]})");
  for (const auto& p : {toml, json}) {
    EXPECT_EQ(p.F(0, 1), 2.5);
    EXPECT_EQ(p.R(0, 0), 2);
    EXPECT_EQ(p.mean(1), 4);
    EXPECT_EQ(p.covariance.rows(), 2);
    EXPECT_EQ(p.state_names, (std::vector<std::string>{"x", "v"}));
  }
}

TEST(ParseLinearGaussian, RefusesByKey) {
  EXPECT_TRUE(refusal_of("m.toml", "F = 1\n").starts_with("m.toml: \"Q\": expected a key of that name, got none"));
  for (const std::string bad : {"F = []\n", "F = [1]\n", "F = [[1], [1, 2]]\n", "F = [[true]]\n", "F = \"1\"\n",
                                "F = [[1979-05-27]]\n", "F = [[[1]]]\n", "F = {a = 1}\n"})
    EXPECT_TRUE(refusal_of("m.toml", bad + kRest).starts_with("m.toml: \"F\": expected ")) << bad;
  EXPECT_NE(refusal_of("m.toml", "F = 1\n" + kRest + "states = \"x\"\n"), "");
  EXPECT_NE(refusal_of("m.toml", "F = 1\n" + kRest + "states = [\"t\"]\n"), "");
  EXPECT_NE(refusal_of("m.toml", "F = 1\n" + kRest + "states = [\"1x\"]\n"), "");
  EXPECT_NE(refusal_of("m.toml", "F = 1\n" + kRest + "states = [3]\n"), "");
  EXPECT_EQ(refusal_of("m.toml", "F = 1\n" + kRest + "states = [\"x_1\"]\n"), "");
}

TEST(ParseLinearGaussian, RefusesWhatIsNoTomlAndNoJson) {
  EXPECT_TRUE(refusal_of("m.toml", "\nF = [[1\n").starts_with("m.toml:"));
  for (const std::string bad : {"", "{", "[1", "{\"F\": 1e999}", "{\"F\": \"\xff\"}", "null x"})
    EXPECT_TRUE(refusal_of("m.json", bad).starts_with("m.json: expected JSON with finite numbers, got ")) << bad;
  for (const std::string other : {"null", "[]", "3", "\"F\""})
    EXPECT_TRUE(refusal_of("m.json", other).starts_with("m.json: \"F\": expected a key")) << other;
}

}  // namespace
}  // namespace mote
