#include "mote/app/track/screen.hpp"

#include <cstdlib>

#include <opencv2/highgui.hpp>

#include "mote/base/refusal.hpp"

namespace mote {

Screen::Screen(const std::string& where) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr)
    throw Refusal(ExitCode::kOutsideTool,
                  {where, "--show", "a display", "none", "Leave it out, or pass --video out.mp4 instead."});
}

void Screen::show(const cv::Mat& frame) const {
  cv::imshow("mote track", frame);
  cv::waitKey(1);
}

}  // namespace mote
