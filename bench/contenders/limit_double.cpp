#include "bench/contenders/limit_kernels.hpp"
#include "bench/contenders/limits.hpp"

namespace mote::contenders {

Contender* new_limit_double() { return new Limit<double>(); }

}  // namespace mote::contenders
