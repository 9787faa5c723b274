#include "bench/contenders/contender.hpp"

#include <limits>

namespace mote::contenders {

Contender::~Contender() = default;
double Contender::outside_seconds() const { return std::numeric_limits<double>::quiet_NaN(); }
double Contender::outside_bytes() const { return std::numeric_limits<double>::quiet_NaN(); }

}  // namespace mote::contenders
