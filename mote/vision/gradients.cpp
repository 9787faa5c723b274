#include "mote/vision/gradients.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::vision {
namespace {

constexpr int kDirections = 18;
constexpr int kOrientations = 9;

/// Unit vectors of the nine orientations.
struct Compass {
  std::array<float, kOrientations> x{}, y{};
  Compass() {
    for (int k = 0; k < kOrientations; ++k) {
      x[static_cast<std::size_t>(k)] = static_cast<float>(std::cos(k * kPi / kOrientations));
      y[static_cast<std::size_t>(k)] = static_cast<float>(std::sin(k * kPi / kOrientations));
    }
  }
};

/// The direction, of 18, that is nearest to a gradient.
int direction_of(float dx, float dy) {
  static const Compass compass;
  float best = 0;
  int which = 0;
  for (int k = 0; k < kOrientations; ++k) {
    const float along = compass.x[static_cast<std::size_t>(k)] * dx + compass.y[static_cast<std::size_t>(k)] * dy;
    if (along > best) best = along, which = k;
    if (-along > best) best = -along, which = k + kOrientations;
  }
  return which;
}

/// Votes of all pixels: rows x columns cells of 18 directions.
class Votes {
 public:
  explicit Votes(const cv::Mat& image)
      : rows_(image.rows / kCell),
        columns_(image.cols / kCell),
        bins_(static_cast<std::size_t>(rows_ * columns_ * kDirections)) {
    for (int y = 1; y < rows_ * kCell - 1; ++y) {
      const auto* above = image.ptr<float>(y - 1);
      const auto* here = image.ptr<float>(y);
      const auto* below = image.ptr<float>(y + 1);
      for (int x = 1; x < columns_ * kCell - 1; ++x) vote(x, y, here[x + 1] - here[x - 1], below[x] - above[x]);
    }
  }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  const float* at(int row, int column) const {
    return bins_.data() + static_cast<std::ptrdiff_t>((row * columns_ + column) * kDirections);
  }

 private:
  void vote(int x, int y, float dx, float dy) {
    const float length = std::sqrt(dx * dx + dy * dy);
    if (length == 0) return;
    const int direction = direction_of(dx, dy);
    const float cx = (static_cast<float>(x) + 0.5F) / kCell - 0.5F;
    const float cy = (static_cast<float>(y) + 0.5F) / kCell - 0.5F;
    const int column = static_cast<int>(std::floor(cx));
    const int row = static_cast<int>(std::floor(cy));
    const float fx = cx - static_cast<float>(column);
    const float fy = cy - static_cast<float>(row);
    add(row, column, direction, length * (1 - fx) * (1 - fy));
    add(row, column + 1, direction, length * fx * (1 - fy));
    add(row + 1, column, direction, length * (1 - fx) * fy);
    add(row + 1, column + 1, direction, length * fx * fy);
  }
  void add(int row, int column, int direction, float weight) {
    if (row < 0 || column < 0 || row >= rows_ || column >= columns_) return;
    bins_[static_cast<std::size_t>((row * columns_ + column) * kDirections + direction)] += weight;
  }

  int rows_, columns_;
  std::vector<float> bins_;
};

/// Squared length of every cell's nine orientations.
cv::Mat energies(const Votes& votes) {
  cv::Mat energy(votes.rows(), votes.columns(), CV_32F);
  for (int row = 0; row < votes.rows(); ++row)
    for (int column = 0; column < votes.columns(); ++column) {
      const float* bin = votes.at(row, column);
      float sum = 0;
      for (int k = 0; k < kOrientations; ++k)
        sum += (bin[k] + bin[k + kOrientations]) * (bin[k] + bin[k + kOrientations]);
      energy.at<float>(row, column) = sum;
    }
  return energy;
}

/// 1 / norm of the four blocks that a cell belongs to; blocks at the border repeat its cells.
std::array<float, 4> block_gains(const cv::Mat& energy, int row, int column) {
  const auto at = [&](int r, int c) {
    return energy.at<float>(std::clamp(r, 0, energy.rows - 1), std::clamp(c, 0, energy.cols - 1));
  };
  std::array<float, 4> gains{};
  std::size_t k = 0;
  for (const int up : {-1, 0})
    for (const int left : {-1, 0}) {
      const float sum = at(row + up, column + left) + at(row + up + 1, column + left) +
                        at(row + up, column + left + 1) + at(row + up + 1, column + left + 1);
      gains[k++] = 1 / std::sqrt(sum + 1e-4F);
    }
  return gains;
}

/// The channels of one cell.
void describe(const float* bin, const std::array<float, 4>& gains, std::array<float, kGradientChannels>& out) {
  constexpr float kCut = 0.2F;
  out.fill(0);
  for (const float gain : gains) {
    float texture = 0;
    for (int k = 0; k < kDirections; ++k) {
      const float value = std::min(bin[k] * gain, kCut);
      out[static_cast<std::size_t>(k)] += 0.5F * value;
      texture += value;
    }
    for (int k = 0; k < kOrientations; ++k)
      out[static_cast<std::size_t>(kDirections + k)] += 0.5F * std::min((bin[k] + bin[k + kOrientations]) * gain, kCut);
    out[static_cast<std::size_t>(kDirections + kOrientations + (&gain - gains.data()))] = 0.2357F * texture;
  }
}

}  // namespace

Planes gradient_histograms(const cv::Mat& image) {
  const Votes votes(image);
  const cv::Mat energy = energies(votes);
  Planes planes;
  for (std::size_t k = 0; k < kGradientChannels; ++k) planes.emplace_back(votes.rows(), votes.columns(), CV_32F);
  std::array<float, kGradientChannels> cell{};
  for (int row = 0; row < votes.rows(); ++row)
    for (int column = 0; column < votes.columns(); ++column) {
      describe(votes.at(row, column), block_gains(energy, row, column), cell);
      for (std::size_t k = 0; k < kGradientChannels; ++k) planes[k].at<float>(row, column) = cell[k];
    }
  return planes;
}

}  // namespace mote::vision
