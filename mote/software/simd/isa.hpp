#pragma once
/// Instruction sets of x86-64 that the SIMD engine is compiled for.

#include <optional>
#include <string_view>

namespace mote {

enum class Isa {
  kSse4,    ///< x86-64-v2 with AES and PCLMUL: processors from 2010 on
  kAvx2,    ///< x86-64-v3 with AES and PCLMUL
  kAvx512,  ///< x86-64-v4 with AES and PCLMUL
};

/// Name of an instruction set as people write it.
std::string_view name_of(Isa isa);

/// The widest of them that this processor has, if any.
std::optional<Isa> best_isa();

}  // namespace mote
