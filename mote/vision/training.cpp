#include "mote/vision/training.hpp"

#include <algorithm>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ml.hpp>

#include "mote/base/refusal.hpp"
#include "mote/vision/detector.hpp"

namespace mote::vision {
namespace {

constexpr int kPatch = 64;  // px

/// A scene in grey, enlarged where it is small.
cv::Mat as_scanned(const cv::Mat& scene) {
  constexpr double kMostEnlarged = 8;
  cv::Mat grey = scene;
  if (scene.channels() == 3) cv::cvtColor(scene, grey, cv::COLOR_BGR2GRAY);
  if (scene.channels() == 4) cv::cvtColor(scene, grey, cv::COLOR_BGRA2GRAY);
  const double enlarge = std::clamp(2.0 * kPatch / std::min(grey.rows, grey.cols), 1.0, kMostEnlarged);
  if (enlarge > 1) cv::resize(grey, grey, {}, enlarge, enlarge, cv::INTER_LINEAR);
  return grey;
}

}  // namespace

void Training::add(const cv::Mat& patch, bool target) {
  std::vector<float> features;
  patch_descriptor().compute(patch, features);
  features_.push_back(cv::Mat(features, true).reshape(1, 1));
  labels_.push_back(target ? 1 : -1);
  positives_ += target;
}

void Training::add_mosaic(const std::string& path, bool target) {
  const cv::Mat mosaic = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (mosaic.empty() || mosaic.rows % kPatch != 0 || mosaic.cols % kPatch != 0)
    throw Refusal(
        ExitCode::kBadData,
        {path, "", "a picture whose sides are multiples of 64 pixels",
         mosaic.empty() ? "none that can be read" : std::to_string(mosaic.cols) + " x " + std::to_string(mosaic.rows),
         "Put the patches side by side."});
  for (int y = 0; y < mosaic.rows; y += kPatch)
    for (int x = 0; x < mosaic.cols; x += kPatch) {
      const cv::Mat patch = mosaic(cv::Rect(x, y, kPatch, kPatch));
      double least = 0;
      double most = 0;
      cv::minMaxLoc(patch, &least, &most);
      if (most > least) add(patch, target);
    }
}

std::size_t Training::add_hard_negatives(const cv::Mat& scene, const std::vector<float>& weights) {
  constexpr std::size_t kMost = 20;
  const cv::Mat seen = as_scanned(scene);
  if (std::min(seen.rows, seen.cols) < kPatch) return 0;  // not even one patch
  std::size_t added = 0;
  for (const Detection& found : Detector(weights).detect(seen)) {
    const cv::Rect place =
        cv::Rect2d(found.box.x, found.box.y, found.box.w, found.box.h) & cv::Rect2d(0, 0, seen.cols, seen.rows);
    if (added == kMost || place.empty()) continue;
    cv::Mat patch;
    cv::resize(seen(place), patch, {kPatch, kPatch}, 0, 0, cv::INTER_AREA);
    add(patch, false);
    ++added;
  }
  return added;
}

std::vector<float> Training::train() const {
  if (positives() == 0 || negatives() == 0)
    throw Refusal(ExitCode::kBadData,
                  {"mote train", "", "patches with and without a target",
                   std::to_string(positives()) + " with and " + std::to_string(negatives()) + " without",
                   "Pass --positives and --negatives."});
  const auto machine = cv::ml::SVM::create();
  machine->setType(cv::ml::SVM::C_SVC);
  machine->setKernel(cv::ml::SVM::LINEAR);
  machine->setC(0.01);
  machine->setTermCriteria({cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 10000, 1e-5});
  machine->train(features_, cv::ml::ROW_SAMPLE, cv::Mat(labels_));
  cv::Mat alpha;
  cv::Mat index;
  const double rho = machine->getDecisionFunction(0, alpha, index);
  const cv::Mat normal = machine->getSupportVectors();  // a linear machine has one
  std::vector<float> weights(normal.begin<float>(), normal.end<float>());
  weights.push_back(static_cast<float>(-rho));
  // which side is which depends on the order in which labels were met: the targets say which is theirs
  double sum = 0;
  for (int row = 0; row < features_.rows; ++row)
    if (labels_[static_cast<std::size_t>(row)] > 0) {
      for (int k = 0; k < normal.cols; ++k)
        sum += static_cast<double>(weights[static_cast<std::size_t>(k)] * features_.at<float>(row, k));
      sum += static_cast<double>(weights.back());
    }
  if (sum < 0)
    for (float& weight : weights) weight = -weight;
  return weights;
}

}  // namespace mote::vision
