#include "mote/vision/drawing.hpp"

#include <cmath>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "mote/base/refusal.hpp"

namespace mote::vision {
namespace {

namespace fs = std::filesystem;

cv::Point at(double x, double y) { return {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))}; }

void outline(cv::Mat& frame, const Affine& map, const cv::Scalar& colour) {
  const auto corner = [&](double u, double v) {
    return at(map.x + u * map.xu + v * map.xv, map.y + u * map.yu + v * map.yv);
  };
  const std::vector<cv::Point> corners{corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)};
  cv::polylines(frame, corners, true, colour, 2, cv::LINE_AA);
}

}  // namespace

cv::Mat annotated(const cv::Mat& frame, const Track& track, const Size& first, std::size_t number, const Box* truth) {
  cv::Mat out;
  if (frame.channels() == 3) out = frame.clone();
  if (frame.channels() == 1) cv::cvtColor(frame, out, cv::COLOR_GRAY2BGR);
  if (frame.channels() == 4) cv::cvtColor(frame, out, cv::COLOR_BGRA2BGR);
  if (truth != nullptr && std::isfinite(truth->x + truth->y + truth->w + truth->h))
    cv::rectangle(out, at(truth->x, truth->y), at(truth->x + truth->w, truth->y + truth->h), {255, 255, 255});
  const cv::Scalar colour = track.lost ? cv::Scalar(0, 0, 255) : cv::Scalar(0, 220, 0);
  for (const cv::Point2f& centre : track.cloud) cv::circle(out, at(centre.x, centre.y), 1, {0, 200, 255}, cv::FILLED);
  if (is_sane(track.pose)) outline(out, affine_of(track.pose, first), colour);
  const std::string text = std::to_string(number) + (track.lost ? "  lost" : cv::format("  %.2f", track.score));
  cv::putText(out, text, {6, 18}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(out, text, {6, 18}, cv::FONT_HERSHEY_SIMPLEX, 0.5, colour, 1, cv::LINE_AA);
  return out;
}

Film::Film(std::string path, double rate) : path_(std::move(path)), rate_(rate), pictures_(pattern_in(path_)) {
  const fs::path target(path_);
  aside_ = (target.parent_path() / (".part-" + target.filename().string())).string();
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) fail();
}

Film::~Film() {
  writer_.release();
  std::error_code ignored;
  if (!pictures_) fs::remove(aside_, ignored);
}

void Film::fail() const {
  throw Refusal(ExitCode::kCannotWrite,
                {path_, "", "a video (.mp4, .avi) or pictures (out%04d.png) that can be written",
                 "a place or format that refuses", "Check folder and ending."});
}

void Film::add(const cv::Mat& frame) {
  ++count_;
  if (pictures_) {
    if (!cv::imwrite(file_of(count_), frame)) fail();
    return;
  }
  if (!writer_.isOpened()) {
    const bool avi = path_.ends_with(".avi");
    const int code = avi ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G') : cv::VideoWriter::fourcc('m', 'p', '4', 'v');
    if (!writer_.open(aside_, code, rate_, frame.size())) fail();
  }
  writer_.write(frame);
}

void Film::commit() {
  if (pictures_) return;
  writer_.release();
  std::error_code error;
  fs::rename(aside_, path_, error);
  if (error) fail();
}

}  // namespace mote::vision
