#include "mote/hardware/cordic.hpp"

#include <cmath>

namespace mote::hardware {
namespace {

double angle_of(Cordic::Mode mode, int shift) {
  const double tangent = std::ldexp(1.0, -shift);
  if (mode == Cordic::Mode::kLinear) return tangent;
  return mode == Cordic::Mode::kCircular ? std::atan(tangent) : std::atanh(tangent);
}

/// "{8'd2, 8'd1}" for the words 1, 2: stage 0 comes last, in the lowest bits.
template <class Number>
std::string packed(const std::vector<Number>& words, int width) {
  std::string text;
  for (const Number word : words)
    text = std::to_string(width) + "'d" + std::to_string(word) + (text.empty() ? "" : ", ") + text;
  return "{" + text + "}";
}

}  // namespace

Cordic::Cordic(Mode mode, bool vectoring, int last, int width, const Format& z, double angle_unit)
    : mode_(mode), vectoring_(vectoring), width_(width), z_(z) {
  for (int shift = mode == Mode::kHyperbolic ? 1 : 0; shift <= last; ++shift) {
    shifts_.push_back(shift);
    if (mode == Mode::kHyperbolic && (shift == 4 || shift == 13 || shift == 40)) shifts_.push_back(shift);
  }
  for (const int shift : shifts_) angles_.push_back(z.nearest(angle_of(mode, shift) / angle_unit));
}

double Cordic::gain() const {
  double gain = 1;
  for (const int shift : shifts_) {
    const double square = std::ldexp(1.0, -2 * shift);
    if (mode_ != Mode::kLinear) gain *= std::sqrt(mode_ == Mode::kCircular ? 1 + square : 1 - square);
  }
  return gain;
}

void Cordic::compute(Columns in, Results out) const {
  for (std::size_t i = 0; i < out[0].size(); ++i) {
    Word x = in[0][i];
    Word y = in[1][i];
    Word z = in[2][i];
    for (std::size_t stage = 0; stage < shifts_.size(); ++stage) {
      const bool negative = vectoring_ ? y >= 0 : z < 0;
      const Word dx = y >> shifts_[stage];
      const Word dy = x >> shifts_[stage];
      if (mode_ != Mode::kLinear) x += negative == (mode_ == Mode::kCircular) ? dx : -dx;
      y += negative ? -dy : dy;
      z += negative ? angles_[stage] : -angles_[stage];
      // as registers of these widths hold them
      x = resized(x, 0, {true, width_ - 1, 0}, {Rounding::kDown, Overflow::kWrap});
      y = resized(y, 0, {true, width_ - 1, 0}, {Rounding::kDown, Overflow::kWrap});
      z = resized(z, 0, {true, z_.width() - 1, 0}, {Rounding::kDown, Overflow::kWrap});
    }
    out[0][i] = x;
    out[1][i] = y;
    out[2][i] = z;
  }
}

Circuit Cordic::circuit() const {
  const int stages = static_cast<int>(shifts_.size());
  return {"mote_cordic",
          {parameter("Mode", static_cast<int>(mode_)),
           parameter("Vectoring", vectoring_),
           parameter("Width", width_),
           parameter("ZWidth", z_.width()),
           parameter("Stages", stages),
           {"Shifts", packed(shifts_, 8)},
           {"Angles", packed(angles_, z_.width())}},
          {{"x_i", width_, true}, {"y_i", width_, true}, port("z_i", z_)},
          {{"x_o", width_, true}, {"y_o", width_, true}, port("z_o", z_)},
          stages,
          false,
          {},
          {},
          Sharing::kAlike};
}

}  // namespace mote::hardware
