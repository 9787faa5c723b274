#pragma once
/// What the tests of lanes/functions.hpp share: the functions with their bounds, and the search for the worst error.

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mote/lanes/functions.hpp"

namespace mote::lanes {

template <class R>
using Wider = std::conditional_t<std::is_same_v<R, float>, double, long double>;

/// A function, the exact one in a wider type, and the promise.
template <class R>
struct Law {
  std::string name;
  std::function<Vector<R>(const Vector<R>&)> vector;
  std::function<Wider<R>(Wider<R>)> exact;
  double bound;  // ulp
};

template <class R>
std::vector<Law<R>> unary_laws() {
  using V = Vector<R>;
  using W = Wider<R>;
  return {
      {"exp", [](const V& x) { return exp(x); }, [](W x) { return std::exp(x); }, 1.5},
      {"log", [](const V& x) { return log(x); }, [](W x) { return std::log(x); }, 1.5},
      {"sin", [](const V& x) { return sin(x); }, [](W x) { return std::sin(x); }, 1.5},
      {"cos", [](const V& x) { return cos(x); }, [](W x) { return std::cos(x); }, 1.5},
      {"tan", [](const V& x) { return tan(x); }, [](W x) { return std::tan(x); }, 4.5},
      {"atan", [](const V& x) { return atan(x); }, [](W x) { return std::atan(x); }, 3.5},
      {"sqrt", [](const V& x) { return sqrt(x); }, [](W x) { return std::sqrt(x); }, 0.5001},
  };
}

/// |got - exact| in units of the last place of the exact value; 0 for two NaN or equal infinities.
template <class R>
double ulps(R got, Wider<R> exact) {
  const R rounded = static_cast<R>(exact);
  if (std::isnan(got) || std::isnan(rounded)) return std::isnan(got) == std::isnan(rounded) ? 0 : HUGE_VAL;
  if (std::isinf(got) || std::isinf(rounded))
    return got == rounded ? 0
           : std::isinf(got) && std::abs(exact) > std::numeric_limits<R>::max() * (Wider<R>(1) - Wider<R>(1e-6))
               ? 0
               : HUGE_VAL;
  const R size = std::max(std::abs(rounded), std::numeric_limits<R>::min());
  const Wider<R> unit = std::ldexp(Wider<R>(1), std::ilogb(size) - (std::numeric_limits<R>::digits - 1));
  return static_cast<double>(std::abs(static_cast<Wider<R>>(got) - exact) / unit);
}

template <class R>
struct Worst {
  double ulps = 0;
  R at = 0, got = 0;
};

/// The arguments of a search: calls visit(x) for each.
template <class R>
using Arguments = std::function<void(const std::function<void(R)>&)>;

/// Every stride-th float there is.
inline Arguments<float> every_float(std::uint64_t stride) {
  return [stride](const auto& visit) {
    for (std::uint64_t bits = 0; bits < (1ULL << 32U); bits += stride)
      visit(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  };
}

/// Doubles of every size and, as many, of the sizes that models meet.
inline Arguments<double> doubles(std::size_t count) {
  return [count](const auto& visit) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> near(-12, 12);
    for (std::size_t i = 0; i < count; ++i) {
      visit(std::bit_cast<double>(random()));
      const double size = near(random);
      visit(std::copysign(std::exp2(size), near(random)));
    }
  };
}

template <class R>
Worst<R> worst(const Law<R>& law, const Arguments<R>& arguments) {
  Worst<R> found;
  std::array<R, kWidth<R>> in{};
  std::array<R, kWidth<R>> out{};
  std::size_t n = 0;
  arguments([&](R x) {
    in[n++] = x;
    if (n < kWidth<R>) return;
    n = 0;
    law.vector(Vector<R>::load(in.data())).store(out.data());
    for (std::size_t i = 0; i < kWidth<R>; ++i)
      if (const double u = ulps<R>(out[i], law.exact(in[i])); u > found.ulps) found = {u, in[i], out[i]};
  });
  return found;
}

template <class R>
void expect_within(const Law<R>& law, const Arguments<R>& arguments) {
  const Worst<R> found = worst(law, arguments);
  EXPECT_LE(found.ulps, law.bound) << law.name << "(" << found.at << ") = " << found.got;
  testing::Test::RecordProperty(law.name, std::to_string(found.ulps));
}

/// A two-argument function on random pairs of every ratio.
template <class R, class F, class G>
void expect_pair_within(const char* name, F vector, G exact, double bound, std::size_t count) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> size(-20, 20);
  Worst<R> found;
  R other = 0;
  std::array<R, kWidth<R>> a{};
  std::array<R, kWidth<R>> b{};
  std::array<R, kWidth<R>> out{};
  for (std::size_t i = 0; i < count; i += kWidth<R>) {
    for (std::size_t k = 0; k < kWidth<R>; ++k) {
      a[k] = static_cast<R>(normal(random) * std::exp2(size(random)));
      b[k] = static_cast<R>(normal(random) * std::exp2(size(random)));
    }
    vector(Vector<R>::load(a.data()), Vector<R>::load(b.data())).store(out.data());
    for (std::size_t k = 0; k < kWidth<R>; ++k)
      if (const double u = ulps<R>(out[k], exact(static_cast<Wider<R>>(a[k]), static_cast<Wider<R>>(b[k])));
          u > found.ulps) {
        found = {u, a[k], out[k]};
        other = b[k];
      }
  }
  EXPECT_LE(found.ulps, bound) << name << "(" << found.at << ", " << other << ") = " << found.got;
  testing::Test::RecordProperty(name, std::to_string(found.ulps));
}

template <class R>
void expect_atan2_within(std::size_t count) {
  expect_pair_within<R>(
      "atan2", [](const auto& y, const auto& x) { return atan2(y, x); },
      [](Wider<R> y, Wider<R> x) { return std::atan2(y, x); }, 4, count);
}
template <class R>
void expect_quotient_within(std::size_t count) {
  expect_pair_within<R>(
      "quotient", [](const auto& y, const auto& x) { return y / x; }, [](Wider<R> y, Wider<R> x) { return y / x; }, 2.5,
      count);
}

}  // namespace mote::lanes
