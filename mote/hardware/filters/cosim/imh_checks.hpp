#pragma once
/// What every IMH circuit is held to: its golden model's integers and cycles.

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "mote/base/scratch_folder.hpp"
#include "mote/hardware/filters/cosim/bench.hpp"
#include "mote/hardware/filters/cosim/models.hpp"
#include "mote/hardware/filters/cosim/sights.hpp"
#include "mote/hardware/filters/imh.hpp"

namespace mote::hardware::cosim {

/// A folder with what $readmemh of the circuits reads, which is the working folder while it is there: simulations look
/// in that. Tests that run side by side have one each.
class TableFolder {
 public:
  TableFolder() : before_(std::filesystem::current_path()) {
    write_tables(folder_.path());
    std::ofstream out(folder_.file("growth.hex"));
    for (const std::int64_t entry : growth_table()) out << std::hex << (entry & 0x3FFFF) << '\n';
    std::filesystem::current_path(folder_.path());
  }
  ~TableFolder() { std::filesystem::current_path(before_); }
  TableFolder(const TableFolder&) = delete;
  TableFolder(TableFolder&&) = delete;
  TableFolder& operator=(const TableFolder&) = delete;
  TableFolder& operator=(TableFolder&&) = delete;

 private:
  std::filesystem::path before_;
  ScratchFolder folder_;
};

/// The formats as they are, once the tables of the circuits are where simulations look.
inline Formats with_tables(const Formats& formats) {
  static const TableFolder folder;
  return formats;
}

/// The registers of an IMH circuit, set on its ports.
inline auto written(const ImhRegisters& r) {
  return [r](auto& top) {
    top.n_i = static_cast<std::uint16_t>(r.particles);
    top.draws_i = static_cast<std::uint16_t>(r.draws);
    top.burn_in_i = static_cast<std::uint16_t>(r.burn_in);
    top.chain_mean_i = r.chain_mean;
  };
}

/// Expects a run of a circuit to be the golden model's in every integer; says how many particle words were compared.
inline std::size_t expect_equal(const Outcome& outcome, Imh& golden, const ImhRegisters& registers,
                                const std::vector<Sight>& sights) {
  EXPECT_TRUE(outcome.complete);
  EXPECT_EQ(outcome.estimates.size(), sights.size());
  EXPECT_EQ(outcome.sets.size(), sights.size());
  golden.start(registers);
  std::size_t compared = 0;
  for (std::size_t k = 0; k < std::min(outcome.estimates.size(), outcome.sets.size()); ++k) {
    const Estimate estimate = golden.step(sights[k].values);
    EXPECT_EQ(outcome.estimates[k], estimate) << "step " << k + 1;
    EXPECT_EQ(outcome.sets[k], golden.set()) << "step " << k + 1;
    compared += golden.set().size() * golden.set()[0].size();
  }
  return compared;
}

/// Runs of many sizes, limits included, on one circuit without a reset in between.
inline std::vector<ImhRegisters> sizes(unsigned lanes) {
  std::vector<ImhRegisters> all{{1, 1, 0, false},    {1, 1, 0, true},        {2, 5, 1, false},
                                {37, 37, 0, true},   {100, 100, 10, false},  {100, 250, 7, false},
                                {64, 64, 300, true}, {1000, 1000, 0, false}, {1024, 4096, 0, false}};
  if (lanes > 1)
    for (ImhRegisters& r : all) {
      r.particles += (lanes - r.particles % lanes) % lanes;
      r.draws += (lanes - r.draws % lanes) % lanes;
    }
  all.push_back({1024, 4032, 64 / lanes, true});
  return all;
}

}  // namespace mote::hardware::cosim
