#pragma once
/// Platforms: machines that clusters are simulated on, as a few numbers.

#include <cstddef>
#include <string>
#include <string_view>

namespace mote::simulated {

/// A cluster for SimGrid.
struct Platform {
  std::string name, meaning;
  std::size_t hosts = 0;  ///< 0: as its file says
  double latency_s = 0;   ///< from host to host; of a ring, of a hop
  double bandwidth = 0;   ///< of a host's link, each way; bytes a second
  bool ring = false;
  std::string file = {};  ///< of another one, written by hand
};

/// red, blue, modern, ideal, ring:N (N cores, 2 to 1024) or FILE.xml.
///
/// error   Refusal (kWrongUse) for another name, (kBadData) for a file that cannot be read
Platform platform_from(const std::string& text, const std::string& where);

/// The platform as SimGrid's XML. Hosts are named host0, host1, ...; each has a link of its own to a switch that is
/// never the bottleneck, or to its two neighbours on a ring, where messages take the shorter way.
std::string platform_xml(const Platform& platform);

/// The names of the hosts, one a line, in their order along the ring; empty where a file says them.
std::string host_list(const Platform& platform);

/// The names there are, for helps and refusals.
inline constexpr std::string_view kPlatforms = "red, blue, modern, ideal, ring:N or FILE.xml";

}  // namespace mote::simulated
