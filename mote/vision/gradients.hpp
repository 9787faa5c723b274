#pragma once
/// Histograms of oriented gradients on cells: the features of the correlation filters.

#include <vector>

#include <opencv2/core.hpp>

namespace mote::vision {

/// Feature planes on a grid of cells, one CV_32F matrix a channel.
using Planes = std::vector<cv::Mat>;

/// Pixels along a side of a cell.
inline constexpr int kCell = 4;
/// Channels of gradient_histograms(): 18 directions, 9 orientations, 4 textures.
inline constexpr std::size_t kGradientChannels = 31;

/// The 31 gradient channels of a grey image, cells of 4 x 4 pixels.
///
///   a gradient votes by its length, for its direction (of 18) and its four nearest cells;
///   a cell's histogram is divided by the norm of each of its four blocks of 2 x 2 cells and cut at 0.2
///
/// shape   image: CV_32F, sides multiples of 4, at least 8; planes: (rows/4) x (columns/4)
/// cost    O(pixels): about 0.2 ms for 160 x 160
/// source  Felzenszwalb et al. 2010, sec. 6
Planes gradient_histograms(const cv::Mat& image);

}  // namespace mote::vision
