#include "mote/hardware/random.hpp"

#include <cmath>

#include "mote/base/normal.hpp"

namespace mote::hardware {

double normal_of(double x) { return -standard_normal_quantile(x / 2 + 0x1p-33); }

Piecewise normal_unit(int fraction, Multiplier multiplier) {
  return fit_piecewise(normal_of, kSignedBits, {true, 3, fraction}, Fold::kMirrored, 0, {1.0, 2, multiplier});
}

double log_uniform_of(double x) { return std::log(x + 0x1p-33); }

Piecewise log_uniform_unit(int fraction, Multiplier multiplier) {
  return fit_piecewise(log_uniform_of, kPlainBits, {true, 5, fraction}, Fold::kPlain, 0, {1.0, 2, multiplier});
}

}  // namespace mote::hardware
