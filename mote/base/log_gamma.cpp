#include "mote/base/log_gamma.hpp"

#include <math.h>  // lgamma_r, which <cmath> need not declare

namespace mote {

double log_gamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

}  // namespace mote
