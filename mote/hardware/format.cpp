#include "mote/hardware/format.hpp"

#include <algorithm>
#include <cmath>

namespace mote::hardware {

double Format::step() const { return std::ldexp(1.0, -fraction); }

Word Format::nearest(double number) const {
  if (std::isnan(number)) return 0;
  const double word = std::nearbyint(std::ldexp(number, fraction));
  if (word >= static_cast<double>(greatest())) return greatest();
  return std::max(least(), static_cast<Word>(std::max(word, -0x1p62)));
}

std::string Format::name() const {
  return (sign ? "s" : "u") + std::to_string(integer) + "." + std::to_string(fraction);
}

}  // namespace mote::hardware
