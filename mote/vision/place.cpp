#include "mote/vision/place.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace mote::vision {
namespace {

constexpr int kRefine = 4;  // points of the response map a cell

int whole_cells(double pixels) { return std::max(kCell * static_cast<int>(std::lround(pixels / kCell)), 2 * kCell); }

cv::Size window_size(const Box& first, const PlaceOptions& options) {
  const double more = options.padding * (first.w + first.h) / 2;
  const double gain = std::sqrt(options.window_area / ((first.w + more) * (first.h + more)));
  return {whole_cells((first.w + more) * gain), whole_cells((first.h + more) * gain)};
}

}  // namespace

View view_of(const cv::Mat& frame) {
  cv::Mat colour;
  if (frame.channels() == 1) cv::cvtColor(frame, colour, cv::COLOR_GRAY2BGR);
  if (frame.channels() == 3) colour = frame;
  if (frame.channels() == 4) cv::cvtColor(frame, colour, cv::COLOR_BGRA2BGR);
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  cv::Mat real;
  grey.convertTo(real, CV_32F);
  bool coloured = false;
  for (int y = 0; y < colour.rows && !coloured; y += 7)
    for (int x = 0; x < colour.cols; x += 7) {
      const auto& p = colour.at<cv::Vec3b>(y, x);
      if (std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) > 16) coloured = true;
    }
  return {Pyramid(real), Pyramid(colour), coloured};
}

double ResponseMap::at(double x, double y) const {
  const double px = (x - x0) * sx;
  const double py = (y - y0) * sy;
  if (!(px >= 0 && py >= 0 && px < values.cols - 1 && py < values.rows - 1)) return outside;
  const int ix = static_cast<int>(px);
  const int iy = static_cast<int>(py);
  const double fx = px - ix;
  const double fy = py - iy;
  const auto v = [&](int dy, int dx) { return static_cast<double>(values.at<float>(iy + dy, ix + dx)); };
  return (1 - fy) * ((1 - fx) * v(0, 0) + fx * v(0, 1)) + fy * ((1 - fx) * v(1, 0) + fx * v(1, 1));
}

Peak peak_of(const ResponseMap& map) {
  double value = 0;
  cv::Point place;
  cv::minMaxLoc(map.values, nullptr, &value, nullptr, &place);
  return {map.x0 + place.x / map.sx, map.y0 + place.y / map.sy, value};
}

PlaceFilter::PlaceFilter(const Box& first, const PlaceOptions& options)
    : options_(options),
      size_(window_size(first, options)),
      per_w_((first.w + options.padding * (first.w + first.h) / 2) / first.w),
      per_h_((first.h + options.padding * (first.w + first.h) / 2) / first.h),
      hann_(hann_window(size_ / kCell)),
      wanted_(gaussian_bump(size_ / kCell,
                            options.bump * std::sqrt(size_.width / per_w_ * size_.height / per_h_) / kCell,
                            options.bump * std::sqrt(size_.width / per_w_ * size_.height / per_h_) / kCell)),
      filter_(wanted_, options.regularisation) {}

Window PlaceFilter::window_around(const Pyramid& image, const Box& box) const {
  return image.cut(box.centre_x(), box.centre_y(), box.w * per_w_, box.h * per_h_, size_);
}

Planes PlaceFilter::features(const View& view, const Box& box) const {
  const cv::Mat grey = window_around(view.grey, box).image;
  Planes planes = gradient_histograms(grey);
  cv::Mat small;
  cv::resize(grey, small, size_ / kCell, 0, 0, cv::INTER_AREA);
  cv::Scalar mean;
  cv::Scalar sd;
  cv::meanStdDev(small, mean, sd);
  small = (small - mean[0]) * (0.2 / std::max(sd[0], 1.0));
  planes.push_back(small);
  for (cv::Mat& plane : planes) plane = plane.mul(hann_);
  return planes;
}

void PlaceFilter::learn(const View& view, const Box& box, double rate) {
  filter_.learn(features(view, box), rate);
  if (view.coloured)
    colour_.learn(window_around(view.colour, box).image, size_.width / per_w_, size_.height / per_h_, 2 * rate);
}

double PlaceFilter::likeness(const View& view, const Box& box) const {
  if (!view.coloured) return 1;
  return colour_.likeness(window_around(view.colour, box).image, size_.width / per_w_, size_.height / per_h_);
}

ResponseMap PlaceFilter::respond(const View& view, const Box& box) const {
  ResponseMap map;
  map.values = filter_.respond(features(view, box), kRefine);
  map.sx = kRefine * (size_.width / kCell) / (box.w * per_w_);
  map.sy = kRefine * (size_.height / kCell) / (box.h * per_h_);
  map.x0 = box.centre_x() - (size_.width / kCell / 2) * kRefine / map.sx;
  map.y0 = box.centre_y() - (size_.height / kCell / 2) * kRefine / map.sy;
  if (!view.coloured || options_.colour_weight == 0) return map;
  const cv::Mat chances = colour_.chances(window_around(view.colour, box).image);
  cv::Mat mean;
  cv::boxFilter(chances, mean, CV_32F,
                cv::Size(static_cast<int>(size_.width / per_w_) | 1, static_cast<int>(size_.height / per_h_) | 1),
                cv::Point(-1, -1), true, cv::BORDER_REPLICATE);
  // the colour map has its centre at the window's centre, the response at its middle cell: the same within half a cell
  const cv::Matx23d to(size_.width / static_cast<double>(map.values.cols), 0, 0, 0,
                       size_.height / static_cast<double>(map.values.rows), 0);
  cv::Mat same;
  const double cx = size_.width / 2.0 - (size_.width / kCell / 2) * kRefine * to(0, 0) - 0.5;
  const double cy = size_.height / 2.0 - (size_.height / kCell / 2) * kRefine * to(1, 1) - 0.5;
  const cv::Matx23d shifted(to(0, 0), 0, cx, 0, to(1, 1), cy);
  cv::warpAffine(mean, same, shifted, map.values.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  map.values = (1 - options_.colour_weight) * map.values + options_.colour_weight * same;
  return map;
}

}  // namespace mote::vision
