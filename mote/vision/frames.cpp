#include "mote/vision/frames.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "mote/base/refusal.hpp"
#include "mote/vision/container.hpp"
#include "mote/vision/pattern.hpp"

namespace mote::vision {
namespace {

namespace fs = std::filesystem;

Refusal bad(const std::string& where, const std::string& what, const std::string& expected, const std::string& got,
            const std::string& next) {
  return {ExitCode::kBadData, {where, what, expected, got, next}};
}

std::string text_of(cv::Size size) { return std::to_string(size.width) + " x " + std::to_string(size.height); }

/// Frames of 8 bits; refuses one that differs in size from the first where it must not.
class Inspection {
 public:
  explicit Inspection(Sizes sizes) : sizes_(sizes) {}

  cv::Mat checked(cv::Mat frame, const std::string& where) {
    if (frame.depth() != CV_8U) frame.convertTo(frame, CV_8U, frame.depth() == CV_16U ? 1.0 / 256 : 255.0);
    if (frame.channels() == 2) cv::extractChannel(frame, frame, 0);
    if (size_.empty() || sizes_ == Sizes::kAny) size_ = frame.size();
    if (frame.size() != size_)
      throw bad(where, "", "a frame of " + text_of(size_) + " pixels as the first", text_of(frame.size()),
                "Cut the video where its size changes.");
    return frame;
  }

 private:
  Sizes sizes_;
  cv::Size size_;
};

/// Numbers in names count by value: frame9 before frame10.
bool name_before(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto number = [&](const std::string& s, std::size_t& k) {
        while (k + 1 < s.size() && s[k] == '0' && digit(s[k + 1])) ++k;
        const std::size_t from = k;
        while (k < s.size() && digit(s[k])) ++k;
        return s.substr(from, k - from);
      };
      const std::string x = number(a, i);
      const std::string y = number(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

class Pictures final : public Frames {
 public:
  Pictures(std::vector<std::string> files, Sizes sizes) : files_(std::move(files)), inspection_(sizes) {}

  std::optional<cv::Mat> next() override {
    if (at_ == files_.size()) return std::nullopt;
    const std::string& file = files_[at_++];
    cv::Mat frame = cv::imread(file, cv::IMREAD_UNCHANGED);
    if (frame.empty())
      throw bad(file, "", "a picture", "a file that cannot be decoded", "Remove it or convert it to PNG or JPEG.");
    return inspection_.checked(std::move(frame), file);
  }
  std::size_t count() const override { return files_.size(); }
  std::vector<std::string> files() const override { return files_; }

 private:
  std::vector<std::string> files_;
  std::size_t at_ = 0;
  Inspection inspection_;
};

/// FFmpeg tells standard error what it dislikes; the refusal says it better.
const std::string& quietly(const std::string& path) {
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  return path;
}

class Video final : public Frames {
 public:
  Video(std::string path, Sizes sizes)
      : path_(std::move(path)), capture_(quietly(path_), cv::CAP_FFMPEG), inspection_(sizes) {
    if (!capture_.isOpened() || !capture_.read(first_) || first_.empty())
      throw bad(path_, "", "a video with at least one frame", "a file that cannot be decoded",
                "Convert it, for example to MP4.");
  }

  std::optional<cv::Mat> next() override {
    cv::Mat frame;
    if (!first_.empty()) {
      std::swap(frame, first_);
    } else if (!capture_.read(frame) || frame.empty()) {
      refuse_if_cut_short();
      return std::nullopt;
    }
    ++at_;
    return inspection_.checked(frame.clone(), path_ + ": frame " + std::to_string(at_));
  }
  std::size_t count() const override {
    const double frames = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    return frames > 0 && frames < 1e9 ? static_cast<std::size_t>(frames) : 0;
  }
  double rate() const override {
    const double rate = capture_.get(cv::CAP_PROP_FPS);
    return rate > 0 && rate < 1000 ? rate : 25;
  }
  std::vector<std::string> files() const override { return {path_}; }
  std::string note() const override {
    if (at_ >= count()) return "";
    const std::string frames = std::to_string(count()) + (counts_ ? " frames" : " frames, which is a guess");
    return path_ + " announces " + frames + ", and " + std::to_string(at_) + " could be decoded. The file is whole.";
  }

 private:
  /// A whole file may have fewer frames than it lists: empty ones, or some that its list of edits cuts out.
  void refuse_if_cut_short() {
    constexpr double kMayMiss = 0.1;  // of the frames
    const Container container = container_of(path_);
    counts_ = container.counts;
    if (counts_ && at_ >= count()) return;
    if (!container.cut && (!counts_ || static_cast<double>(at_) >= (1 - kMayMiss) * static_cast<double>(count())))
      return;
    throw bad(path_, "", container.cut ? "a whole video" : "the " + std::to_string(count()) + " frames that it lists",
              (container.cut ? "a file cut short after " : "no more than ") + std::to_string(at_) +
                  " frames that can be decoded",
              "Fetch it again, or pass --frames " + std::to_string(at_) + ".");
  }

  std::string path_;
  cv::VideoCapture capture_;
  cv::Mat first_;
  std::size_t at_ = 0;
  bool counts_ = false;
  Inspection inspection_;
};

bool is_picture(const fs::path& path) {
  std::string end = path.extension().string();
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::vector<std::string> known{".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".tif", ".tiff", ".webp"};
  return std::find(known.begin(), known.end(), end) != known.end();
}

std::vector<std::string> in_folder(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_picture(entry.path()) && entry.is_regular_file()) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end(), name_before);
  if (files.empty())
    throw bad(folder, "", "pictures (png, jpg, bmp, pgm, ppm, tif, webp)", "a folder without any",
              "Name the folder that holds the frames.");
  return files;
}

std::vector<std::string> by_pattern(const std::string& path, const Pattern& pattern) {
  std::vector<std::string> files;
  for (std::size_t k = 0;; ++k) {
    std::string file = pattern.name(k);
    if (fs::exists(file)) {
      files.push_back(std::move(file));
    } else if (k > 0 || !files.empty()) {
      break;
    }
  }
  if (files.empty())
    throw bad(path, "", "pictures numbered from 0 or 1", "no such file",
              "Check the pattern, for example shot%04d.jpg.");
  return files;
}

}  // namespace

std::unique_ptr<Frames> open_frames(const std::string& path, Sizes sizes) {
  std::error_code unknown;
  if (fs::is_directory(path, unknown)) return std::make_unique<Pictures>(in_folder(path), sizes);
  if (!fs::exists(path, unknown)) {
    if (const auto pattern = pattern_in(path)) return std::make_unique<Pictures>(by_pattern(path, *pattern), sizes);
    throw bad(path, "", "a video file, a folder of pictures or a pattern such as shot%04d.jpg", "nothing of that name",
              "Check the path.");
  }
  if (is_picture(path)) return std::make_unique<Pictures>(std::vector<std::string>{path}, sizes);
  return std::make_unique<Video>(path, sizes);
}

}  // namespace mote::vision
