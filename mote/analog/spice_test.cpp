// ngspice through its library: what it answers, and what it refuses.

#include "mote/analog/spice.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"

namespace mote::analog {
namespace {

TEST(Spice, IsNamedWhenItIsMissing) {
  try {
    Spice("no-such-library.so");
    FAIL() << "nothing was refused";
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kOutsideTool);
    EXPECT_NE(std::string(refusal.what()).find("libngspice0-dev"), std::string::npos) << refusal.what();
  }
}

// referee  Ohm's law, and the charging of a capacitor through a resistor
TEST(Spice, SolvesADividerAndACharge) {
  Spice& spice = Spice::loaded();
  spice.take({"* divider", "vin in 0 0", "r1 in out 1k", "r2 out 0 3k"});
  spice.run("dc vin 0 4 1");
  const std::vector<double> out = spice.values("v(out)");
  ASSERT_EQ(out.size(), 5U);
  for (std::size_t k = 0; k < out.size(); ++k) EXPECT_NEAR(out[k], 0.75 * static_cast<double>(k), 1e-9);
  spice.take({"* charge", "vin in 0 pwl(0 0 1n 1)", "r1 in out 1k", "c1 out 0 1u", ".options reltol=1e-6"});
  spice.run("tran 10u 2m 0 2u");
  EXPECT_NEAR(spice.values("v(out)").back(), 1 - std::exp(-2.0), 1e-4);
}

TEST(Spice, ShowsWhatItSaidWhenItFails) {
  const auto refused = [](const std::vector<std::string>& lines, const std::string& command) {
    try {
      Spice::loaded().take(lines);
      Spice::loaded().run(command);
      (void)Spice::loaded().values("v(a)");
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kOutsideTool);
      return std::string(refusal.what());
    }
    return std::string("nothing was refused");
  };
  EXPECT_NE(refused({"* two sources fight", "v1 a 0 1", "v2 a 0 2", "r1 a 0 1"}, "op").find("ngspice: "),
            std::string::npos);
  EXPECT_NE(refused({"* no such node", "v1 b 0 1", "r1 b 0 1"}, "op").find("v(a)"), std::string::npos);
}

}  // namespace
}  // namespace mote::analog
