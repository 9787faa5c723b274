#pragma once
/// Platforms: machines that clusters are simulated on. Their numbers, and where these come from, are in the files of
/// data/platforms.

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace mote::simulated {

/// A cluster for SimGrid. Hosts are named host0, host1, ...; each has a link of its own to a switch that is never the
/// bottleneck, or to its two neighbours on a ring, where messages take the shorter way.
struct Platform {
  std::string name, meaning;
  std::string xml = {};       ///< as SimGrid reads it; empty for a file written by hand
  std::string file = {};      ///< of such a one
  std::size_t hosts = 0;      ///< 0: as that file says
  double link_latency_s = 0;  ///< of a host's link, two of which a message crosses; of a ring, of a hop
  double bandwidth = 0;       ///< of a link, each way; bytes a second
  bool ring = false;
};

/// red, blue, modern, ideal, ring:N (N cores, 2 to 1024) or FILE.xml.
///
/// error   Refusal (kWrongUse) for another name, (kBadData) for a file that cannot be read
Platform platform_from(const std::string& text, const std::string& where);

/// What the files of data/platforms hold, by their names; the program has them in it.
const std::map<std::string_view, std::string_view>& platform_files();

/// The names of the hosts, one a line, in their order along the ring; empty where a file says them.
std::string host_list(const Platform& platform);

/// The names there are, for helps and refusals.
inline constexpr std::string_view kPlatforms = "red, blue, modern, ideal, ring:N or FILE.xml";

}  // namespace mote::simulated
