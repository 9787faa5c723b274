#pragma once
/// The logarithm of the gamma function.

namespace mote {

/// log Gamma(x).
///
/// Unlike std::lgamma, which notes the sign of Gamma in a variable of the whole process, it may be called by several
/// threads, and a compiler may take it out of a loop.
///
/// shape   x > 0
/// error   a few units in the last place (glibc)
[[gnu::const]] double log_gamma(double x);

}  // namespace mote
