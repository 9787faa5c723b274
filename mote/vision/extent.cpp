#include "mote/vision/extent.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::vision {
namespace {

constexpr int kRefine = 8;

cv::Size rung_size(const Box& first, double area) {
  const double gain = std::sqrt(area / first.area());
  const auto cells = [&](double side) {
    return kCell * std::clamp(static_cast<int>(std::lround(side * gain / kCell)), 2, 16);
  };
  return {cells(first.w), cells(first.h)};
}

}  // namespace

double ExtentResponse::at(double log_ratio) const {
  const double place = std::clamp(middle + log_ratio / log_step, 0.0, static_cast<double>(values.size()) - 1.001);
  const auto k = static_cast<std::size_t>(place);
  const double f = place - static_cast<double>(k);
  return (1 - f) * static_cast<double>(values[k]) + f * static_cast<double>(values[k + 1]);
}

ExtentFilter::ExtentFilter(const Box& first, const ExtentOptions& options)
    : options_(options), size_(rung_size(first, options.area)) {
  cv::dft(gaussian_bump({options.steps, 1}, options.bump, 1), wanted_, cv::DFT_COMPLEX_OUTPUT | cv::DFT_ROWS);
}

/// One row a feature, one column a size: the spectrum along the ladder.
cv::Mat ExtentFilter::ladder(const View& view, const Box& box) const {
  cv::Mat rows;
  const int middle = options_.steps / 2;
  for (int k = 0; k < options_.steps; ++k) {
    const double factor = std::pow(options_.ratio, k - middle);
    const Window window = view.grey.cut(box.centre_x(), box.centre_y(), box.w * factor, box.h * factor, size_);
    const Planes planes = gradient_histograms(window.image);
    const int cells = planes.front().rows * planes.front().cols;
    if (rows.empty()) rows.create(cells * static_cast<int>(planes.size()), options_.steps, CV_32F);
    const double hann = 0.5 * (1 - std::cos(2 * kPi * (k + 1) / (options_.steps + 1)));
    int row = 0;
    for (const cv::Mat& plane : planes)
      for (int cell = 0; cell < cells; ++cell)
        rows.at<float>(row++, k) = static_cast<float>(hann) * plane.ptr<float>()[cell];
  }
  cv::Mat spectrum;
  cv::dft(rows, spectrum, cv::DFT_COMPLEX_OUTPUT | cv::DFT_ROWS);
  return spectrum;
}

void ExtentFilter::learn(const View& view, const Box& box, double rate) {
  const cv::Mat f = ladder(view, box);
  const bool first = numerators_.empty();
  const auto a = static_cast<float>(first ? 1 : rate);
  if (first) {
    numerators_ = cv::Mat::zeros(f.size(), CV_32FC2);
    denominator_ = cv::Mat::zeros(1, f.cols, CV_32F);
  }
  numerators_ *= 1 - a;
  denominator_ *= 1 - a;
  add_conjugate_product(wanted_, f, a, numerators_);
  add_power(f, a, denominator_);
}

ExtentResponse ExtentFilter::respond(const View& view, const Box& box) const {
  const cv::Mat z = ladder(view, box);
  cv::Mat sum = cv::Mat::zeros(1, z.cols, CV_32FC2);
  add_conjugate_product(numerators_, z, 1, sum);
  const int middle = options_.steps / 2 * kRefine;
  cv::Mat response = response_of(sum, denominator_, options_.regularisation, kRefine);
  return {{response.begin<float>(), response.end<float>()},
          std::log(options_.ratio) / kRefine,
          static_cast<double>(middle)};
}

}  // namespace mote::vision
