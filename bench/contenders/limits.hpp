#pragma once

namespace mote::contenders {

class Contender;

/// The limits, made by code compiled for AVX-512: to be called where the machine has it; the caller owns what it gets.
Contender* new_limit_float();
Contender* new_limit_double();

}  // namespace mote::contenders
