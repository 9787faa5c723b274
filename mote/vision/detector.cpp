#include "mote/vision/detector.hpp"

#include <algorithm>
#include <fstream>

#include <opencv2/imgproc.hpp>

#include "mote/base/refusal.hpp"

namespace mote::vision {
namespace {

/// The best of those that overlap, best first.
std::vector<Detection> thinned(std::vector<Detection> all) {
  std::stable_sort(all.begin(), all.end(), [](const Detection& a, const Detection& b) { return a.score > b.score; });
  std::vector<Detection> kept;
  for (const Detection& d : all)
    if (std::none_of(kept.begin(), kept.end(), [&](const Detection& k) { return overlap(k.box, d.box) > 0.3; }))
      kept.push_back(d);
  return kept;
}

}  // namespace

cv::HOGDescriptor patch_descriptor() { return {{64, 64}, {16, 16}, {8, 8}, {8, 8}, 9}; }

Detector Detector::people() {
  Detector detector;
  detector.hog_.setSVMDetector(cv::HOGDescriptor::getDefaultPeopleDetector());
  detector.keep_w_ = 0.56;
  detector.keep_h_ = 0.8;
  detector.threshold_ = 0.3;
  detector.least_height_ = 480;
  return detector;
}

Detector::Detector(const std::vector<float>& weights) : hog_(patch_descriptor()), threshold_(0.2) {
  hog_.setSVMDetector(weights);
}

Detector Detector::from_file(const std::string& path) {
  std::ifstream file(path);
  std::vector<float> weights;
  for (float weight = 0; file >> weight;) weights.push_back(weight);
  const std::size_t expected = patch_descriptor().getDescriptorSize() + 1;
  if (!file.eof() || weights.size() != expected)
    throw Refusal(ExitCode::kBadData, {path, "", "a detector of " + std::to_string(expected) + " numbers",
                                       std::to_string(weights.size()) + " numbers", "Make one with mote train."});
  return Detector(weights);
}

std::vector<Detection> Detector::detect(const cv::Mat& frame) const {
  // smaller frames are enlarged, at most twice
  const double enlarge = std::clamp(least_height_ / frame.rows, 1.0, 2.0);
  cv::Mat seen;
  cv::resize(frame, seen, {}, enlarge, enlarge, cv::INTER_LINEAR);
  std::vector<cv::Rect> places;
  std::vector<double> scores;
  hog_.detectMultiScale(seen, places, scores, threshold_, {8, 8}, {}, 1.05, 0.0, false);
  std::vector<Detection> found;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const cv::Rect& p = places[k];
    const double w = p.width * keep_w_ / enlarge;
    const double h = p.height * keep_h_ / enlarge;
    const double x = (p.x + p.width / 2.0) / enlarge;
    const double y = (p.y + p.height / 2.0) / enlarge;
    found.push_back({{x - w / 2, y - h / 2, w, h}, scores[k]});
  }
  return thinned(std::move(found));
}

}  // namespace mote::vision
