// Who may run the limits: compiled like the program, so that asking does not need the instructions asked for.

#include "bench/contenders/limits.hpp"

#include "bench/contenders/contender.hpp"

namespace mote::contenders {
namespace {

#ifdef MOTE_LIMITS_BUILT
std::string why_not() {
  const bool all = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                   __builtin_cpu_supports("avx512vpopcntdq") && __builtin_cpu_supports("fma");
  return all ? std::string() : "this machine has no AVX-512 with VPOPCNTDQ";
}
std::unique_ptr<Contender> make_float() { return std::unique_ptr<Contender>(new_limit_float()); }
std::unique_ptr<Contender> make_double() { return std::unique_ptr<Contender>(new_limit_double()); }
#else
std::string why_not() { return "it is written for x86-64 and was not built"; }
std::unique_ptr<Contender> make_float() { return nullptr; }
std::unique_ptr<Contender> make_double() { return nullptr; }
#endif

}  // namespace

const Description kLimitFloat{"limit", "fused by hand for AVX-512, float", 4 * 4 + 8 + 3, why_not, make_float};
const Description kLimitDouble{"limit", "fused by hand for AVX-512, states in double", 4 * 8 + 8 + 3, why_not,
                               make_double};

}  // namespace mote::contenders
