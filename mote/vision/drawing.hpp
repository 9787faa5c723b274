#pragma once
/// Drawing: a frame with what the tracker thinks of it, and the video or the pictures that such frames make.

#include <memory>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "mote/vision/pattern.hpp"
#include "mote/vision/tracker.hpp"

namespace mote::vision {

/// The frame with the particles' centres, the affine outline (green; red when lost), frame number and score; the true
/// box in white when there is one.
cv::Mat annotated(const cv::Mat& frame, const Track& track, const Size& first, std::size_t number, const Box* truth);

/// A video, or numbered pictures when the name is a pattern such as out%04d.png. A video is written aside and gets its
/// name by commit().
///
/// error   Refusal (kCannotWrite) when it cannot be written
class Film {
 public:
  Film(std::string path, double rate);
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  Film(Film&&) = delete;
  Film& operator=(Film&&) = delete;

  void add(const cv::Mat& frame);
  void commit();
  /// The file that the frame of a number, from 1 on, goes to.
  std::string file_of(std::size_t number) const { return pictures_ ? pictures_->name(number) : path_; }
  /// Whether every frame goes to a file of its own.
  bool pictures() const { return pictures_.has_value(); }

 private:
  [[noreturn]] void fail() const;

  std::string path_, aside_;
  double rate_;
  std::optional<Pattern> pictures_;
  std::size_t count_ = 0;
  cv::VideoWriter writer_;
};

}  // namespace mote::vision
