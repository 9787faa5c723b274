#pragma once
/// Correlation filters learnt online: where the target is, and how large. They tell the target from what surrounds it,
/// which the appearance model, knowing the target alone, cannot.

#include <vector>

#include <opencv2/core.hpp>

#include "mote/vision/gradients.hpp"

namespace mote::vision {

/// A correlation filter over several channels.
///
///   A_k <- (1 - a) A_k + a conj(Y) F_k,   B <- (1 - a) B + a sum_k |F_k|^2,   Y = DFT of the wanted response
///   response = DFT^-1 [ sum_k conj(A_k) Z_k / (B + lambda) ]
///
/// shape   channels of one size; the wanted response is a Gaussian of height 1 at the grid's centre
/// cost    one DFT a channel to learn and one to respond
/// source  Bolme et al. 2010; Danelljan et al. 2014, eq. (4), (5), (6)
class CorrelationFilter {
 public:
  /// wanted: the response to the target, CV_32F.
  CorrelationFilter(const cv::Mat& wanted, double regularisation);

  /// Learns the channels with rate a; the first time as if a = 1.
  void learn(const Planes& channels, double rate);
  /// The response to other channels, interpolated to `refine` points a cell (exact for band-limited responses).
  cv::Mat respond(const Planes& channels, int refine) const;
  bool empty() const { return numerators_.empty(); }

 private:
  double regularisation_;
  cv::Mat wanted_;  // DFT of the wanted response
  std::vector<cv::Mat> numerators_;
  cv::Mat denominator_;
};

/// target += scale conj(a) b, element by element; spectra are CV_32FC2. A single row of `a` stands for every row of
/// `b`, and a target of a single row takes the sum over the rows.
void add_conjugate_product(const cv::Mat& a, const cv::Mat& b, float scale, cv::Mat& target);

/// target += scale |a|^2, likewise; target is CV_32F.
void add_power(const cv::Mat& a, float scale, cv::Mat& target);

/// DFT^-1 [ sum / (denominator + lambda) ] on `refine` points a cell.
cv::Mat response_of(const cv::Mat& sum, const cv::Mat& denominator, double regularisation, int refine);

/// A Gaussian of height 1 around the middle cell (rows/2, columns/2) of a grid.
cv::Mat gaussian_bump(cv::Size size, double sd_x, double sd_y);

/// The two-dimensional Hann window.
cv::Mat hann_window(cv::Size size);

}  // namespace mote::vision
