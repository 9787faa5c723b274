#include "mote/base/normal.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "mote/base/normals.hpp"

namespace mote {
namespace {

using Octet = std::array<double, 8>;

double horner(const Octet& c, double x) {
  double sum = c[7];
  for (int i = 6; i >= 0; --i) sum = sum * x + c[static_cast<std::size_t>(i)];
  return sum;
}

// Coefficients of Wichura's PPND16: numerator and denominator for |p - 1/2| <= 0.425, then r <= 5 and r > 5
// with r = sqrt(-log(min(p, 1 - p))).
constexpr Octet kCentreA{3.3871328727963666080e0,  1.3314166789178437745e+2, 1.9715909503065514427e+3,
                         1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                         3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr Octet kCentreB{1.0,
                         4.2313330701600911252e+1,
                         6.8718700749205790830e+2,
                         5.3941960214247511077e+3,
                         2.1213794301586595867e+4,
                         3.9307895800092710610e+4,
                         2.8729085735721942674e+4,
                         5.2264952788528545610e+3};
constexpr Octet kTailC{1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                       3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                       2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr Octet kTailD{1.0,
                       2.05319162663775882187e0,
                       1.67638483018380384940e0,
                       6.89767334985100004550e-1,
                       1.48103976427480074590e-1,
                       1.51986665636164571966e-2,
                       5.47593808499534494600e-4,
                       1.05075007164441684324e-9};
constexpr Octet kFarE{6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                      2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                      2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr Octet kFarF{1.0,
                      5.99832206555887937690e-1,
                      1.36929880922735805310e-1,
                      1.48753612908506148525e-2,
                      7.86869131145613259100e-4,
                      1.84631831751005468180e-5,
                      1.42151175831644588870e-7,
                      2.04426310338993978564e-15};

double centre(double q) {
  const double r = 0.180625 - q * q;
  return q * horner(kCentreA, r) / horner(kCentreB, r);
}

constexpr double kFar = 5.0;
double near_tail(double r) { return horner(kTailC, r - 1.6) / horner(kTailD, r - 1.6); }
double far_tail(double r) { return horner(kFarE, r - kFar) / horner(kFarF, r - kFar); }

/// The magnitude of the quantile of a tail probability below 0.075.
double tail(double p) {
  const double r = std::sqrt(-std::log(p));
  return r <= kFar ? near_tail(r) : far_tail(r);
}

constexpr double kTail = 0.075;  // |p - 1/2| = 0.425

/// |z| for a tail probability u in (0, 1/2].
double magnitude(double u) { return u >= kTail ? -centre(u - 0.5) : tail(u); }

constexpr std::uint64_t kSignBit = 1ULL << 63U;

/// The tail probability in 64 random bits.
double tail_probability(std::uint64_t bits) {
  return (static_cast<double>(static_cast<std::int64_t>(bits & ~kSignBit)) + 0.5) * 0x1p-64;
}

/// normal_from_bits() of at most kMost words. Steps are loops of their own, which compilers turn into vectors; all but
/// the logarithms of the tails, of which there are few.
constexpr std::size_t kMost = 512;
void normals_of(const std::uint64_t* bits, std::size_t count, double* z) {
  std::array<double, kMost> u;
  std::array<std::uint32_t, kMost> tails;
  std::array<double, kMost> r;
  std::array<double, kMost> near;
  std::size_t few = 0;
  for (std::size_t i = 0; i < count; ++i) u[i] = tail_probability(bits[i]);
  for (std::size_t i = 0; i < count; ++i) z[i] = -centre(u[i] - 0.5);
  for (std::size_t i = 0; i < count; ++i) {
    tails[few] = static_cast<std::uint32_t>(i);
    few += u[i] < kTail ? 1 : 0;
  }
  for (std::size_t k = 0; k < few; ++k) r[k] = std::log(u[tails[k]]);
  for (std::size_t k = 0; k < few; ++k) r[k] = std::sqrt(-r[k]);
  for (std::size_t k = 0; k < few; ++k) near[k] = near_tail(r[k]);
  for (std::size_t k = 0; k < few; ++k) z[tails[k]] = near[k];
  for (std::size_t k = 0; k < few; ++k)
    if (r[k] > kFar) z[tails[k]] = far_tail(r[k]);
  for (std::size_t i = 0; i < count; ++i)
    z[i] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(z[i]) ^ (bits[i] & kSignBit));
}

}  // namespace

double standard_normal_quantile(double p) { return p <= 0.5 ? -magnitude(p) : magnitude(1.0 - p); }

double normal_from_bits(std::uint64_t bits) {
  const double z = magnitude(tail_probability(bits));
  return (bits & kSignBit) != 0 ? -z : z;
}

void normals_from_bits(std::span<const std::uint64_t> bits, std::span<double> normals) {
  for (std::size_t first = 0; first < bits.size(); first += kMost)
    normals_of(bits.data() + first, std::min(kMost, bits.size() - first), normals.data() + first);
}

float normal_from_bits(std::uint32_t bits, std::uint64_t more) {
  constexpr std::uint32_t kSign = 1U << 31U;
  const std::uint32_t m = bits & ~kSign;
  const double v = m < (1U << 15U) ? uniform_from_bits(more) : 0.5;
  const auto z = static_cast<float>(magnitude((m + v) * 0x1p-32));
  return (bits & kSign) != 0 ? -z : z;
}

}  // namespace mote
