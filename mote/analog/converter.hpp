#pragma once
/// Data converters between digital and analog parts: range, bits, nonlinearity, noise, rate, power.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "mote/base/draws.hpp"

namespace mote::analog {

/// What a data sheet says of a converter. An error in LSB is in steps of the converter's own bits.
struct ConverterSheet {
  std::string name;
  int bits = 8;          ///< 0: none is there, values pass as they are
  double inl_lsb = 0;    ///< largest deviation of a code from the straight line
  double dnl_lsb = 0;    ///< largest deviation of a step from one LSB
  double noise_lsb = 0;  ///< standard deviation of a conversion
  double rate_hz = 0;    ///< conversions a second
  double power_w = 0;
};

/// TLC5615: 10 bits, 75 kHz, 0.75 mW.
///
/// source  MIXED sec. V and its [14], Texas Instruments SLAS142D: INL 1 LSB, DNL 0.5 LSB at most
ConverterSheet tlc5615();

/// ADS7830: 8 bits, 70 kHz, 0.18 mW.
///
/// source  MIXED sec. V and its [15], Texas Instruments SBAS302A: INL and DNL 0.5 LSB at most; noise below them
ConverterSheet ads7830();

/// The converter with other bits, its errors the same in LSB. A bit more is twice the power: that of a conversion goes
/// with the number of its steps.
///
/// shape   bits: 0 to kMostBits; 0: none is there
/// source  Walden 1999, the figure of merit P / (2^bits rate)
ConverterSheet with_bits(ConverterSheet sheet, int bits);

/// The most bits that a converter may have.
inline constexpr int kMostBits = 16;

/// Which way a converter goes.
enum class Direction { kToAnalog, kToDigital };

/// A converter over a range.
///
///   code = round((x - low) / LSB + noise), cut to 0 ... 2^bits - 1
///   to analog: y = low + LSB (code + error(code));   to digital: code less its error, rounded; y = low + LSB code
///
/// The error of a code is a bow of the height that the INL leaves and a uniform number within half the DNL, drawn for
/// each code of each converter by address.
///
/// shape   low < high; LSB = (high - low) / (2^bits - 1)
/// error   none: NaN stays NaN
/// cost    one look-up; 2^bits numbers
class Converter {
 public:
  /// `number` says which converter of a design it is.
  Converter(const ConverterSheet& sheet, Direction direction, double low, double high, std::uint64_t seed,
            std::uint32_t number);

  /// `normal` is a standard normal number.
  double operator()(double x, double normal) const {
    if (errors_.empty() || std::isnan(x)) return x;
    const double place = (x - low_) * per_lsb_ + noise_lsb_ * normal;
    const double code = nearest(place);
    const double error = errors_[static_cast<std::size_t>(code)];
    return low_ + lsb_ * (direction_ == Direction::kToAnalog ? code + error : nearest(place - error));
  }
  /// The same of a converter to analog whose errors are known by measurement: the output that is nearest to x.
  ///
  /// cost    some look-ups more
  double calibrated(double x, double normal) const;
  bool noisy() const { return noise_lsb_ > 0 && !errors_.empty(); }

 private:
  double nearest(double place) const {
    return std::floor(std::clamp(place, 0.0, static_cast<double>(errors_.size() - 1)) + 0.5);
  }

  Direction direction_;
  double low_, lsb_ = 0, per_lsb_ = 0, noise_lsb_;
  std::vector<double> errors_;  ///< by code, in LSB; empty: none is there
  int reach_ = 0;               ///< how many codes away an output may be that is nearer than the code's own
};

}  // namespace mote::analog
