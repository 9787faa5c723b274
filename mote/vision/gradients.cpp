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

/// Gradients along a row of pixels: their lengths and the nearest of the 18 directions.
class RowOfGradients {
 public:
  explicit RowOfGradients(int columns)
      : dx_(size(columns)), dy_(dx_), best_(dx_), length_(dx_), direction_(dx_.size()) {}

  /// From rows y - 1, y and y + 1 of an image; the first and the last column have none.
  void see(const float* above, const float* here, const float* below) {
    static const Compass compass;
    const std::size_t n = dx_.size();
    for (std::size_t x = 1; x + 1 < n; ++x) {
      dx_[x] = here[x + 1] - here[x - 1];
      dy_[x] = below[x] - above[x];
      length_[x] = std::sqrt(dx_[x] * dx_[x] + dy_[x] * dy_[x]);
      best_[x] = 0;
      direction_[x] = 0;
    }
    for (int k = 0; k < kOrientations; ++k) {
      const float cx = compass.x[static_cast<std::size_t>(k)];
      const float cy = compass.y[static_cast<std::size_t>(k)];
      for (std::size_t x = 1; x + 1 < n; ++x) {
        const float along = cx * dx_[x] + cy * dy_[x];
        direction_[x] = along > best_[x] ? k : -along > best_[x] ? k + kOrientations : direction_[x];
        best_[x] = std::max(best_[x], std::abs(along));
      }
    }
  }
  float length(int x) const { return length_[size(x)]; }
  int direction(int x) const { return direction_[size(x)]; }

 private:
  static std::size_t size(int n) { return static_cast<std::size_t>(n); }

  std::vector<float> dx_, dy_, best_, length_;
  std::vector<int> direction_;
};

/// A pixel between two neighbouring cells along an axis.
struct Between {
  int cell;     ///< the first of them, from -1
  float share;  ///< of the second
};
Between between(int pixel) {
  const float at = (static_cast<float>(pixel) + 0.5F) / kCell - 0.5F;
  const int cell = static_cast<int>(std::floor(at));
  return {cell, at - static_cast<float>(cell)};
}

/// Votes of all pixels: rows x columns cells of 18 directions, and a rim of cells that nobody reads.
class Votes {
 public:
  explicit Votes(const cv::Mat& image)
      : rows_(image.rows / kCell),
        columns_(image.cols / kCell),
        bins_(static_cast<std::size_t>((rows_ + 2) * (columns_ + 2) * kDirections)) {
    RowOfGradients gradients(columns_ * kCell);
    for (int y = 1; y < rows_ * kCell - 1; ++y) {
      gradients.see(image.ptr<float>(y - 1), image.ptr<float>(y), image.ptr<float>(y + 1));
      const Between row = between(y);
      for (int x = 1; x < columns_ * kCell - 1; ++x)
        vote(row, between(x), gradients.length(x), static_cast<std::size_t>(gradients.direction(x)));
    }
  }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  const float* at(int row, int column) const { return bins_.data() + place(row, column); }

 private:
  std::ptrdiff_t place(int row, int column) const {
    return (static_cast<std::ptrdiff_t>(row + 1) * (columns_ + 2) + column + 1) * kDirections;
  }
  void vote(Between row, Between column, float length, std::size_t direction) {
    float* upper = bins_.data() + place(row.cell, column.cell) + direction;
    float* lower = upper + place(1, 0) - place(0, 0);
    upper[0] += length * (1 - column.share) * (1 - row.share);
    upper[kDirections] += length * column.share * (1 - row.share);
    lower[0] += length * (1 - column.share) * row.share;
    lower[kDirections] += length * column.share * row.share;
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
      out[static_cast<std::size_t>(kDirections) + static_cast<std::size_t>(k)] +=
          0.5F * std::min((bin[k] + bin[k + kOrientations]) * gain, kCut);
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
