#include "mote/base/log_gamma.hpp"

#include <cmath>

namespace mote {

double log_gamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

}  // namespace mote
