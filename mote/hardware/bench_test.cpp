#include "mote/hardware/bench.hpp"

#include <algorithm>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/hardware/arithmetic.hpp"
#include "mote/hardware/bench_laws.hpp"
#include "mote/hardware/rtl_library.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {
namespace {

constexpr Format kByte{true, 3, 4};

/// A sum whose data sheet is wrong.
struct Late : Sum {
  Circuit circuit() const {
    Circuit wrong = Sum::circuit();
    ++wrong.latency;
    return wrong;
  }
};

/// A sum whose twin rounds otherwise than the circuit.
struct Rough : Sum {
  void compute(Columns in, Results out) const { Sum{a, b, y, false, {Rounding::kDown}}.compute(in, out); }
};

TEST(Library, LeavesOutWhatACommentNames) {
  const std::vector<RtlFile> files =
      needed_of_library("// as mote_imh is\nmodule m;\n  mote_sisr u ();  // no mote_chain\n");
  const auto has = [&](std::string_view name) {
    return std::any_of(files.begin(), files.end(), [&](const RtlFile& file) { return file.name == name; });
  };
  EXPECT_TRUE(has("mote_sisr.sv") && has("mote_steps.sv"));
  EXPECT_FALSE(has("mote_imh.sv") || has("mote_chain.sv") || has("mote_log_uniform.sv"));
}

// The twins that must fail: without them a bench that compares nothing would pass.
TEST(Lockstep, CatchesAWrongLatency) {
  Lockstep wrong;
  wrong.add(Late{{kByte, kByte, kByte}});
  EXPECT_NONFATAL_FAILURE(wrong.expect_agreement(1000), "mote_add");
}

TEST(Lockstep, CatchesAnotherRounding) {
  Lockstep wrong;
  wrong.add(Rough{{kByte, kByte, {true, 4, 2}}});
  EXPECT_NONFATAL_FAILURE(wrong.expect_agreement(1000), "mote_add");
}

TEST(Bench, RefusesWhatVerilatorWarnsAbout) {
  Circuit wrong = Sum{kByte, kByte, kByte}.circuit();
  wrong.inputs[0].width = 5;
  try {
    const Bench bench({wrong});
    FAIL();
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kOutsideTool);
    EXPECT_NE(std::string(refusal.what()).find("WIDTH"), std::string::npos) << refusal.what();
  }
}

TEST(Tools, NameThePackageOfAMissingProgram) {
  try {
    run_tool("mote-no-such-program", "yosys", {});
    FAIL();
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kOutsideTool);
    EXPECT_STREQ(
        refusal.what(),
        "mote-no-such-program: expected the program on PATH, got No such file or directory. Install it: apt-get "
        "install yosys.");
  }
}

TEST(RtlLibrary, HoldsAModuleOfItsNameInEveryFile) {
  EXPECT_GE(rtl_library().size(), 9U);
  for (const RtlFile& file : rtl_library()) {
    const std::string module = "\nmodule " + std::string(file.name.substr(0, file.name.size() - 3)) + " ";
    EXPECT_NE(file.text.find(module), std::string_view::npos) << file.name;
    EXPECT_EQ(file.text.substr(0, 3), "// ") << file.name << ": a data sheet comes first";
  }
}

}  // namespace
}  // namespace mote::hardware
