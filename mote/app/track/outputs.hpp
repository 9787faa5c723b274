#pragma once
/// What `mote track` leaves: boxes, summary, report, annotated video, live window.

#include <optional>

#include "mote/app/commands/command.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/track/pursuit.hpp"
#include "mote/app/track/screen.hpp"
#include "mote/vision/drawing.hpp"
#include "mote/vision/frames.hpp"
#include "mote/vision/sheet.hpp"

namespace mote {

/// The outputs of one track, opened before the work, committed together after the last frame that could be tracked.
class TrackOutputs {
 public:
  /// `most` frames are tracked at most.
  ///
  /// error   Refusal (kWrongUse) when an output would go over a file that is read, or over another output
  TrackOutputs(const Arguments& arguments, const vision::Frames& frames, std::size_t most);

  /// The live window; nullptr without --show.
  const Screen* screen() const { return screen_ ? &*screen_ : nullptr; }
  /// Writes and shows the frame that was tracked last.
  void add(const cv::Mat& frame, Pursuit& run);
  void commit(const TrackRecord& record);

 private:
  void claim_pictures(std::size_t number);

  OutputSet set_;
  Output *boxes_, *summary_, *report_, *sheet_file_;
  std::string sheet_ending_;
  std::optional<vision::Sheet> sheet_;
  std::optional<vision::Film> film_;
  std::size_t reserved_ = 0;  // pictures of the film
  std::optional<Screen> screen_;
};

}  // namespace mote
