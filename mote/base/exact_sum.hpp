#pragma once
/// Sums that do not depend on the order of their terms, so that threads and processes may form them in any groups.

#include <cmath>
#include <cstdint>

namespace mote {

/// A sum in fixed point: every term is cut to a multiple of 2^-96, and whole numbers of 128 bits are added.
///
/// shape   terms and their sum below 2^30 in magnitude
/// error   none; a term that is not finite must not come
/// cost    a few instructions a term
class ExactSum {
 public:
  void add(double term) {
    const double high = term * 0x1p33;
    const auto whole = static_cast<std::int64_t>(high);
    const auto rest = static_cast<std::int64_t>((high - static_cast<double>(whole)) * 0x1p63);
    whole_ += (static_cast<Whole>(whole) << 63) + rest;
  }
  ExactSum& operator+=(const ExactSum& other) {
    whole_ += other.whole_;
    return *this;
  }
  /// The sum, rounded once.
  double value() const { return static_cast<double>(whole_) * 0x1p-96; }

  friend bool operator==(const ExactSum& a, const ExactSum& b) { return a.whole_ == b.whole_; }

 private:
  __extension__ using Whole = __int128;
  Whole whole_ = 0;
};

}  // namespace mote
