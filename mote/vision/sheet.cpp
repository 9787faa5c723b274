#include "mote/vision/sheet.hpp"

#include <algorithm>

#include <opencv2/imgcodecs.hpp>

namespace mote::vision {

Sheet::Sheet(const std::vector<std::size_t>& numbers) {
  for (const std::size_t number : numbers) frames_.try_emplace(number);
}

void Sheet::add(std::size_t number, const cv::Mat& frame) { frames_.at(number) = frame.clone(); }

std::string Sheet::picture(const std::string& ending) const {
  constexpr int kColumns = 3;
  constexpr int kGap = 4;  // px
  std::vector<cv::Mat> there;
  for (const auto& [number, frame] : frames_)
    if (!frame.empty()) there.push_back(frame);
  if (there.empty()) return "";
  const auto count = static_cast<int>(there.size());
  const int columns = std::min(kColumns, count);
  const int rows = (count + columns - 1) / columns;
  const cv::Size step = there.front().size() + cv::Size(kGap, kGap);
  cv::Mat sheet(rows * step.height - kGap, columns * step.width - kGap, there.front().type(), cv::Scalar::all(255));
  for (int k = 0; k < count; ++k) {
    const cv::Point corner(k % columns * step.width, k / columns * step.height);
    const cv::Mat& frame = there[static_cast<std::size_t>(k)];
    frame.copyTo(sheet(cv::Rect(corner, frame.size())));
  }
  std::vector<unsigned char> bytes;
  cv::imencode(ending, sheet, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace mote::vision
