#include "mote/vision/patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace mote::vision {
namespace {

/// One row of the patch: pixels from (x, y) in steps of (dx, dy), in the coordinates of pixel centres.
///
/// Three loops: the first and the last become vectors, the one between moves pairs of neighbours, which no vector load
/// can. In one loop g++ makes no vectors of it at all.
void sample_row(const float* image, int stride, float right, float bottom, float x, float y, float dx, float dy,
                float* z) {
  std::array<int, kSide> at;
  std::array<float, kSide> fx;
  std::array<float, kSide> fy;
  for (std::size_t i = 0; i < kSide; ++i) {
    const auto k = static_cast<float>(static_cast<int>(i));
    const float px = std::min(std::max(x + k * dx, 0.0F), right);
    const float py = std::min(std::max(y + k * dy, 0.0F), bottom);
    const int ix = static_cast<int>(px);
    const int iy = static_cast<int>(py);
    fx[i] = px - static_cast<float>(ix);
    fy[i] = py - static_cast<float>(iy);
    at[i] = iy * stride + ix;
  }
  std::array<float, 2 * kSide> upper;
  std::array<float, 2 * kSide> lower;
  for (std::size_t i = 0; i < kSide; ++i) {
    std::memcpy(&upper[2 * i], image + at[i], 2 * sizeof(float));
    std::memcpy(&lower[2 * i], image + at[i] + stride, 2 * sizeof(float));
  }
  for (std::size_t i = 0; i < kSide; ++i) {
    const float above = upper[2 * i] + fx[i] * (upper[2 * i + 1] - upper[2 * i]);
    const float below = lower[2 * i] + fx[i] * (lower[2 * i + 1] - lower[2 * i]);
    z[i] = above + fy[i] * (below - above);
  }
}

}  // namespace

void sample_patch(const Window& window, const Affine& map, std::span<float> z) {
  const cv::Mat& image = window.image;
  const auto f = [](double value) { return static_cast<float>(value); };
  // the last place whose right and lower neighbours exist
  const float right = std::nextafter(f(image.cols - 1), 0.0F);
  const float bottom = std::nextafter(f(image.rows - 1), 0.0F);
  const double step = 1.0 / kSide;
  const double first = 0.5 * step - 0.5;
  const double x = window.to_x(map.x + first * (map.xu + map.xv)) - 0.5;
  const double y = window.to_y(map.y + first * (map.yu + map.yv)) - 0.5;
  const int stride = static_cast<int>(image.step1());
  for (std::size_t row = 0; row < kSide; ++row) {
    const double v = static_cast<double>(row) * step;
    sample_row(image.ptr<float>(), stride, right, bottom, f(x + v * map.xv * window.sx), f(y + v * map.yv * window.sy),
               f(map.xu * window.sx * step), f(map.yu * window.sy * step), z.data() + row * kSide);
  }
}

namespace {

/// sum_j f(z_j) in sixteen interleaved sums, so that the order is fixed and vectors do it.
template <class F>
float interleaved_sum(std::span<const float> z, F f) {
  constexpr std::size_t kLanes = 16;
  float sums[kLanes] = {};
  for (std::size_t j = 0; j < kPixels; j += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) sums[lane] += f(z[j + lane]);
  float sum = 0;
  for (const float part : sums) sum += part;
  return sum;
}

}  // namespace

void normalise_patch(std::span<float> z) {
  constexpr float kShare = 1.0F / kPixels;
  const float mean = kShare * interleaved_sum(z, [](float value) { return value; });
  const float variance = kShare * interleaved_sum(z, [mean](float value) { return (value - mean) * (value - mean); });
  const float gain = 1 / std::max(std::sqrt(variance), kLeastContrast);
  for (std::size_t j = 0; j < kPixels; ++j) z[j] = (z[j] - mean) * gain;
}

}  // namespace mote::vision
