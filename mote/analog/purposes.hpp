#pragma once
/// What the draws of analog parts are for, beside those of behaviour.hpp.

#include "mote/base/draws.hpp"

namespace mote::analog {

inline constexpr Purpose kConverterErrors{66};   ///< one uniform number a code
inline constexpr Purpose kPartErrors{67};        ///< one normal number a vertex: gains that differ from part to part
inline constexpr Purpose kMultiplierErrors{68};  ///< one normal number a particle: the multiplier that weighs it

}  // namespace mote::analog
