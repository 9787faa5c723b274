#include "mote/vision/correlation.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::vision {
namespace {

cv::Mat spectrum(const cv::Mat& real) {
  cv::Mat out;
  const int by_rows = real.rows == 1 ? cv::DFT_ROWS : 0;
  cv::dft(real, out, cv::DFT_COMPLEX_OUTPUT | by_rows);
  return out;
}

}  // namespace

void add_conjugate_product(const cv::Mat& a, const cv::Mat& b, float scale, cv::Mat& target) {
  for (int row = 0; row < b.rows; ++row) {
    const auto* x = a.ptr<float>(std::min(row, a.rows - 1));
    const auto* y = b.ptr<float>(row);
    auto* out = target.ptr<float>(std::min(row, target.rows - 1));
    for (int k = 0; k < 2 * a.cols; k += 2) {
      out[k] += scale * (x[k] * y[k] + x[k + 1] * y[k + 1]);
      out[k + 1] += scale * (x[k] * y[k + 1] - x[k + 1] * y[k]);
    }
  }
}

void add_power(const cv::Mat& a, float scale, cv::Mat& target) {
  for (int row = 0; row < a.rows; ++row) {
    const auto* x = a.ptr<float>(row);
    auto* out = target.ptr<float>(std::min(row, target.rows - 1));
    for (int k = 0; k < a.cols; ++k) out[k] += scale * (x[2 * k] * x[2 * k] + x[2 * k + 1] * x[2 * k + 1]);
  }
}

namespace {

/// The spectrum of a grid `refine` times as fine: the low frequencies keep their places at both ends.
cv::Mat refined(const cv::Mat& spectrum, int refine_rows, int refine_columns) {
  cv::Mat out = cv::Mat::zeros(spectrum.rows * refine_rows, spectrum.cols * refine_columns, spectrum.type());
  const auto place = [](int k, int n, int many) { return k < (n + 1) / 2 ? k : k + many * n - n; };
  for (int row = 0; row < spectrum.rows; ++row)
    for (int column = 0; column < spectrum.cols; ++column)
      out.at<cv::Vec2f>(place(row, spectrum.rows, refine_rows), place(column, spectrum.cols, refine_columns)) =
          spectrum.at<cv::Vec2f>(row, column);
  return out;
}

}  // namespace

CorrelationFilter::CorrelationFilter(const cv::Mat& wanted, double regularisation)
    : regularisation_(regularisation), wanted_(spectrum(wanted)) {}

void CorrelationFilter::learn(const Planes& channels, double rate) {
  const auto a = static_cast<float>(empty() ? 1 : rate);
  if (empty()) {
    denominator_ = cv::Mat::zeros(wanted_.size(), CV_32F);
    for (std::size_t k = 0; k < channels.size(); ++k) numerators_.push_back(cv::Mat::zeros(wanted_.size(), CV_32FC2));
  }
  denominator_ *= 1 - a;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const cv::Mat f = spectrum(channels[k]);
    numerators_[k] *= 1 - a;
    add_conjugate_product(wanted_, f, a, numerators_[k]);
    add_power(f, a, denominator_);
  }
}

cv::Mat CorrelationFilter::respond(const Planes& channels, int refine) const {
  cv::Mat sum = cv::Mat::zeros(wanted_.size(), CV_32FC2);
  for (std::size_t k = 0; k < channels.size(); ++k)
    add_conjugate_product(numerators_[k], spectrum(channels[k]), 1, sum);
  return response_of(sum, denominator_, regularisation_, refine);
}

cv::Mat response_of(const cv::Mat& sum, const cv::Mat& denominator, double regularisation, int refine) {
  cv::Mat quotient(sum.size(), CV_32FC2);
  for (int row = 0; row < sum.rows; ++row)
    for (int column = 0; column < sum.cols; ++column)
      quotient.at<cv::Vec2f>(row, column) =
          sum.at<cv::Vec2f>(row, column) / (denominator.at<float>(row, column) + static_cast<float>(regularisation));
  const bool line = sum.rows == 1;
  const cv::Mat fine = refined(quotient, line ? 1 : refine, refine);
  cv::Mat response;
  cv::dft(fine, response, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | (line ? cv::DFT_ROWS : 0));
  response /= static_cast<double>(sum.rows) * sum.cols;
  return response;
}

cv::Mat gaussian_bump(cv::Size size, double sd_x, double sd_y) {
  cv::Mat out(size, CV_32F);
  const cv::Point middle(size.width / 2, size.height / 2);
  for (int row = 0; row < size.height; ++row)
    for (int column = 0; column < size.width; ++column) {
      const double x = (column - middle.x) / sd_x;
      const double y = (row - middle.y) / sd_y;
      out.at<float>(row, column) = static_cast<float>(std::exp(-0.5 * (x * x + y * y)));
    }
  return out;
}

cv::Mat hann_window(cv::Size size) {
  cv::Mat out(size, CV_32F);
  const auto hann = [](int k, int n) { return n == 1 ? 1 : 0.5 * (1 - std::cos(2 * kPi * (k + 0.5) / n)); };
  for (int row = 0; row < size.height; ++row)
    for (int column = 0; column < size.width; ++column)
      out.at<float>(row, column) = static_cast<float>(hann(row, size.height) * hann(column, size.width));
  return out;
}

}  // namespace mote::vision
