#pragma once
/// Colour histograms of target and surroundings: which pixels are likely to be the target's.

#include <array>

#include <opencv2/core.hpp>

namespace mote::vision {

/// Two colour histograms, of the target and of what surrounds it, and the chance that a colour is the target's.
///
///   p(target | colour) = h_target / (h_target + h_surroundings),   each h a histogram of 16^3 bins that sums to 1
///
/// source  Bertinetto et al. 2016, sec. 3.3; Possegger et al. 2015
class ColourModel {
 public:
  /// Learns a window (CV_8UC3) whose middle w x h pixels are the target, with rate a; the first time as if a = 1.
  void learn(const cv::Mat& window, double w, double h, double rate);
  /// How alike the colours of the middle w x h pixels of a window (CV_8UC3) and those learnt of the target are.
  ///
  ///   sum_k sqrt(h_window(k) h_target(k)),   in [0, 1]
  ///
  /// source  Comaniciu, Ramesh & Meer 2003, eq. (7): the Bhattacharyya coefficient
  double likeness(const cv::Mat& window, double w, double h) const;
  /// The chance of every pixel, CV_32F in [0, 1].
  cv::Mat chances(const cv::Mat& window) const;

 private:
  static constexpr std::size_t kBins = 4096;
  std::array<float, kBins> target_{}, around_{};
  bool empty_ = true;
};

}  // namespace mote::vision
