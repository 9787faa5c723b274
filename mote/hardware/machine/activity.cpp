#include "mote/hardware/machine/activity.hpp"

#include <sstream>

namespace mote::hardware {
namespace {

/// Bits, and how often they changed together.
struct Changes {
  double bits = 0, count = 0;

  double share(double cycles) const { return bits > 0 && cycles > 0 ? count / (bits * cycles) : 0; }
};

}  // namespace

// A line is  C '\1<key>\2<value>...' <count>;  the page is v_toggle/<module>.
Activity activity_of(const std::string& points, std::uint64_t cycles) {
  Changes fabric, products;
  std::istringstream lines(points);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.rfind("' ");
    const std::size_t page = line.find("v_toggle/");
    if (end == std::string::npos || page == std::string::npos) continue;
    Changes& of = line.compare(page + 9, 12, "mote_product") == 0 ? products : fabric;
    of.bits += 1;
    of.count += std::stod(line.substr(end + 2));
  }
  const auto clocks = static_cast<double>(cycles);
  return {fabric.share(clocks), products.bits > 0 ? products.share(clocks) : fabric.share(clocks), true};
}

}  // namespace mote::hardware
