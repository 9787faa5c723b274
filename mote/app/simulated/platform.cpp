#include "mote/app/simulated/platform.hpp"

#include <array>
#include <filesystem>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote::simulated {
namespace {

constexpr long long kMostCores = 1024;

/// The numbers and where they come from. IMH-OPT says what the nodes of its clusters are, and nothing of their network.
Platform built_in(const std::string& name) {
  // Switched 100 Mbit Ethernet: the rate of the wire; 70 us is what MPICH over TCP took on such machines: our
  // assumption.
  if (name == "red")
    return {name, "the Red cluster of IMH-OPT: 16 Pentium II (400 MHz); switched 100 Mbit Ethernet assumed", 16, 70e-6,
            12.5e6};
  if (name == "blue")
    return {name, "the Blue cluster of IMH-OPT: 12 Pentium III (550 MHz); switched 100 Mbit Ethernet assumed", 12,
            70e-6, 12.5e6};
  // 100 Gbit InfiniBand (EDR, HDR100) and its usual MPI latency through a switch or two.
  if (name == "modern")
    return {name, "1024 nodes, a rank each, on 100 Gbit InfiniBand with full bisection", 1024, 1.5e-6, 12.5e9};
  return {"ideal", "1024 nodes whose messages take no time: what the latency laws speak of", 1024, 0, 1e18};
}

/// Starburst's cores have 100 MHz and its ring moves a word of 4 bytes a cycle and hop. A message costs what its
/// copying in software does, not counted here.
Platform ring(long long cores) {
  return {fmt::format("ring:{}", cores),
          fmt::format("{} cores of 100 MHz on a ring, like Starburst's: a hop takes a cycle, a word a cycle", cores),
          static_cast<std::size_t>(cores),
          10e-9,
          400e6,
          true};
}

}  // namespace

Platform platform_from(const std::string& text, const std::string& where) {
  for (const char* name : {"red", "blue", "modern", "ideal"})
    if (text == name) return built_in(text);
  const auto refused = [&](const std::string& expected) {
    return Refusal(ExitCode::kWrongUse, {where, "--platform", expected, "\"" + text + "\"", "Pass --platform modern."});
  };
  if (text.starts_with("ring:")) {
    const auto cores = integer_in(text.substr(5));
    if (!cores || *cores < 2 || *cores > kMostCores)
      throw refused(fmt::format("ring:N, N cores from 2 to {}", kMostCores));
    return ring(*cores);
  }
  if (!text.ends_with(".xml")) throw refused(std::string(kPlatforms));
  std::error_code error;
  if (!std::filesystem::is_regular_file(text, error))
    throw Refusal(ExitCode::kBadData,
                  {text, "", "a platform file of SimGrid", "no file that can be read", "Check the path."});
  return {.name = text, .meaning = "as the file says", .file = std::filesystem::absolute(text).string()};
}

std::string platform_xml(const Platform& platform) {
  // a message crosses its sender's link and its receiver's; on a ring, a link for each hop
  const double link_latency = platform.ring ? platform.latency_s : platform.latency_s / 2;
  const std::string topology =
      platform.ring ? fmt::format(" topology=\"TORUS\" topo_parameters=\"{}\"", platform.hosts) : "";
  return fmt::format(
      "<?xml version='1.0'?>\n"
      "<!DOCTYPE platform SYSTEM \"https://simgrid.org/simgrid.dtd\">\n"
      "<!-- {} -->\n"
      "<platform version=\"4.1\">\n"
      "  <cluster id=\"cluster\" prefix=\"host\" suffix=\"\" radical=\"0-{}\" speed=\"1Gf\" bw=\"{:g}Bps\" "
      "lat=\"{:g}s\"{}/>\n"
      "</platform>\n",
      platform.meaning, platform.hosts - 1, platform.bandwidth, link_latency, topology);
}

std::string host_list(const Platform& platform) {
  std::string list;
  for (std::size_t host = 0; host < platform.hosts; ++host) list += fmt::format("host{}\n", host);
  return list;
}

}  // namespace mote::simulated
