#include "bench/contenders/limit_kernels.hpp"
#include "bench/contenders/limits.hpp"

namespace mote::contenders {

Contender* new_limit_float() { return new Limit<float>(); }

}  // namespace mote::contenders
