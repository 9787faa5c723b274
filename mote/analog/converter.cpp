#include "mote/analog/converter.hpp"

#include "mote/analog/purposes.hpp"
#include "mote/base/numbers.hpp"

namespace mote::analog {

ConverterSheet tlc5615() { return {"TLC5615", 10, 1, 0.5, 0, 75e3, 0.75e-3}; }
ConverterSheet ads7830() { return {"ADS7830", 8, 0.5, 0.5, 0, 70e3, 0.18e-3}; }

ConverterSheet with_bits(ConverterSheet sheet, int bits) {
  if (bits == sheet.bits) return sheet;
  sheet.name += " with " + std::to_string(bits) + " bits";
  sheet.power_w = bits == 0 ? 0 : std::ldexp(sheet.power_w, bits - sheet.bits);
  sheet.bits = bits;
  return sheet;
}

Converter::Converter(const ConverterSheet& sheet, Direction direction, double low, double high, std::uint64_t seed,
                     std::uint32_t number)
    : direction_(direction), low_(low), noise_lsb_(sheet.noise_lsb) {
  if (sheet.bits == 0) return;
  errors_.resize(std::size_t{1} << static_cast<unsigned>(sheet.bits));
  const auto last = static_cast<double>(errors_.size() - 1);
  lsb_ = (high - low) / last;
  per_lsb_ = 1 / lsb_;
  const double ripple = std::min(sheet.dnl_lsb / 2, sheet.inl_lsb);  // two neighbours differ by twice that at most
  const double bow = sheet.inl_lsb - ripple;
  reach_ = static_cast<int>(std::ceil(sheet.inl_lsb)) + 1;
  const Draws draws{seed, 0, number};
  draws.for_each(kConverterErrors, 0, errors_.size(), [&](std::size_t code, auto& draw) {
    errors_[code] = bow * std::sin(kPi * static_cast<double>(code) / last) + ripple * (2 * draw.uniform() - 1);
  });
}

double Converter::calibrated(double x, double normal) const {
  if (errors_.empty() || std::isnan(x)) return x;
  const double place = (x - low_) * per_lsb_ + noise_lsb_ * normal;
  const auto middle = static_cast<int>(nearest(place));
  double output = 0;
  double distance = kInfinity;
  for (int code = std::max(0, middle - reach_); code <= middle + reach_ && code < static_cast<int>(errors_.size());
       ++code) {
    const double of_code = code + errors_[static_cast<std::size_t>(code)];
    if (std::abs(of_code - place) >= distance) continue;
    distance = std::abs(of_code - place);
    output = of_code;
  }
  return low_ + lsb_ * output;
}

}  // namespace mote::analog
