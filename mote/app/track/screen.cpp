#include "mote/app/track/screen.hpp"

#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <opencv2/highgui.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

const std::string kWindow = "mote track";
constexpr int kPlain = cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL;  // the frame alone, pixel for pixel

bool has_display() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

/// Whether the display opens a window. The window's library ends the program when it does not, so a child tries.
bool opens_a_window() {
  const pid_t child = fork();
  if (child == 0) {
    if (std::freopen("/dev/null", "w", stderr) != nullptr) cv::namedWindow(kWindow, kPlain);
    _exit(0);
  }
  int status = 1;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// What is printed meanwhile goes to standard error: standard output may be a file of boxes.
class StandardOutputAside {
 public:
  StandardOutputAside() : kept_((std::fflush(stdout), dup(STDOUT_FILENO))) { dup2(STDERR_FILENO, STDOUT_FILENO); }
  ~StandardOutputAside() {
    std::fflush(stdout);
    dup2(kept_, STDOUT_FILENO);
    close(kept_);
  }
  StandardOutputAside(const StandardOutputAside&) = delete;
  StandardOutputAside& operator=(const StandardOutputAside&) = delete;
  StandardOutputAside(StandardOutputAside&&) = delete;
  StandardOutputAside& operator=(StandardOutputAside&&) = delete;

 private:
  int kept_;
};

}  // namespace

Screen::Screen(std::string where) : where_(std::move(where)) {
  if (!has_display() || !opens_a_window())
    throw Refusal(ExitCode::kOutsideTool,
                  {where_, "--show", "a display", has_display() ? "one that opens no window" : "none",
                   "Leave it out: pass --init or --detect, and --video out.mp4 to see the result."});
  cv::namedWindow(kWindow, kPlain);
}

void Screen::show(const cv::Mat& frame) const {
  cv::imshow(kWindow, frame);
  cv::waitKey(1);
}

vision::Box Screen::choose(const cv::Mat& frame) const {
  constexpr int kLeastSide = 4;
  const StandardOutputAside aside;
  const cv::Rect box = cv::selectROI(kWindow, frame, false);
  if (box.width >= kLeastSide && box.height >= kLeastSide) {
    const cv::Rect2d drawn = box;
    return {drawn.x, drawn.y, drawn.width, drawn.height};
  }
  throw Refusal(ExitCode::kWrongUse,
                {where_, "--show", "a box of at least 4 x 4 pixels drawn with the mouse",
                 box.empty() ? "none" : fmt::format("{} x {}", box.width, box.height), "Pass --init x,y,w,h instead."});
}

}  // namespace mote
