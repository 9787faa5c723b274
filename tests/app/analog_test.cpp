// `mote analog`: what it answers, and what it refuses.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote {
namespace {

using testing::Ended;
using testing::Scratch;
using Json = nlohmann::json;

/// The figures are those of papers/mixed/table2.toml; here is that they are where a reader looks for them.
TEST(Analog, CharacterisesBothCircuits) {
  const Scratch scratch;
  const Ended ended = scratch.shell("mote analog characterise --dies 2 --json a.json --report a.html");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("mode of the weights shifted by 0."), std::string::npos) << ended.out;
  const Json found = Json::parse(scratch.read("a.json"));
  for (const char* circuit : {"arctan", "gaussian"}) {
    ASSERT_GE(found[circuit].size(), 6U);
    ASSERT_EQ(found["ideal"][circuit].size(), found[circuit].size());
    for (std::size_t k = 0; k < found[circuit].size(); ++k) {
      const Json& row = found[circuit][k];
      EXPECT_EQ(row["ia_na"], found["ideal"][circuit][k]["ia_na"]);
      EXPECT_GT(row["rms_percent"], found["ideal"][circuit][k]["rms_percent"]);
      EXPECT_GE(row["max_percent"], row["rms_percent"]);
      EXPECT_EQ(row.contains("max_deg"), std::string(circuit) == "arctan");
      EXPECT_GT(row["power_uw"], 0);
      EXPECT_LT(row["residual_percent"], 1e-3);
    }
  }
  EXPECT_EQ(found["arctan"][0]["ia_na"], 0.5);
  EXPECT_EQ(found["gaussian"][0]["ia_na"], 0.1);
  EXPECT_EQ(found["dies"].size(), 4U);
  EXPECT_EQ(found["weights"].size(), 2U);
  EXPECT_NE(scratch.read("a.html").find("Weights at sigma_r = 0.29 deg"), std::string::npos);
}

TEST(Analog, RefusesTheAbsurdInASentence) {
  const Scratch scratch;
  for (const auto& [words, sentence] : std::map<std::string, std::string>{
           {"--supply 0", "mote analog characterise: --supply: expected"},
           {"--temperature 1000", "mote analog characterise: --temperature: expected"},
           {"--temperature nan", "mote analog characterise: --temperature: expected"},
           {"--dies -1", "mote analog characterise: --dies: expected an integer from 0 to 10000, got -1"}}) {
    const Ended ended = scratch.shell("mote analog characterise " + words + " --json a.json");
    EXPECT_EQ(ended.code, 2) << words;
    EXPECT_EQ(ended.err.find(sentence), 0U) << ended.err;
    EXPECT_TRUE(scratch.files().empty());
  }
}

/// What stands for ngspice here is no library.
TEST(Analog, NamesNgspiceWhenItIsMissing) {
  const Scratch scratch;
  scratch.write("libngspice.so.0", "no library");
  const Ended ended = scratch.shell("LD_LIBRARY_PATH=. mote analog characterise --json a.json");
  EXPECT_EQ(ended.code, 5);
  EXPECT_EQ(ended.err.find("ngspice: expected its shared library, got "), 0U) << ended.err;
  EXPECT_NE(ended.err.find("apt-get install libngspice0-dev"), std::string::npos) << ended.err;
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_EQ(scratch.files().size(), 1U) << "no output is left";
}

}  // namespace
}  // namespace mote
