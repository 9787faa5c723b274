#pragma once
/// Frames: a video file, a folder of pictures or a numbered pattern, read one after the other.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace mote::vision {

/// Where frames come from.
class Frames {
 public:
  virtual ~Frames() = default;

  /// The next frame, 8 bits, 1, 3 or 4 channels; nothing at the end.
  ///
  /// error   Refusal (kBadData) naming the frame when it cannot be read or its size differs from the first; at the end
  ///         of a video that was cut short: its file ends before it says, or more than a tenth of the frames that it
  ///         lists cannot be decoded
  virtual std::optional<cv::Mat> next() = 0;
  /// How many frames there are in all; 0 = unknown.
  virtual std::size_t count() const = 0;
  /// Frames per second; 25 where the source does not say.
  virtual double rate() const { return 25; }
  /// The files that are read.
  virtual std::vector<std::string> files() const = 0;
  /// After the end, what is to be said of it; empty = nothing: a whole video with fewer frames than announced, because
  /// the count was a guess, or because frames are empty or cut out by the video's own list.
  virtual std::string note() const { return ""; }

 protected:
  Frames() = default;
  Frames(const Frames&) = default;
  Frames(Frames&&) = default;
  Frames& operator=(const Frames&) = default;
  Frames& operator=(Frames&&) = default;
};

/// Which sizes frames may have.
enum class Sizes {
  kOne,  ///< that of the first
  kAny,  ///< each its own
};

/// Opens a video file, a folder (its pictures in the order of their names, numbers by value) or a pattern such as
/// shot%04d.jpg (from its first number, 0 or 1, on).
///
/// error   Refusal (kBadData) when there is nothing there, or no frame in it
std::unique_ptr<Frames> open_frames(const std::string& path, Sizes sizes = Sizes::kOne);

}  // namespace mote::vision
