#pragma once
/// Box files: what `mote track` writes, and truths to score against.

#include <string>
#include <vector>

#include "mote/vision/tracker.hpp"

namespace mote {

/// Columns of `mote track`'s output, with the line's end.
std::string boxes_header();

/// A frame as a line: frame, box, score, lost, then the six affine parameters. Before a target is chosen they are nan.
std::string boxes_line(std::size_t frame, const vision::Track& track);

/// How a file without a header states boxes.
enum class BoxFormat {
  kAuto,   ///< a header: kBoxes; else kOtb or kTld, whichever first box is nearer to --init
  kBoxes,  ///< CSV with a header that has frame, x, y, w, h: 0-based corner
  kOtb,    ///< x,y,w,h with a 1-based corner, by commas, blanks or tabs
  kTld,    ///< x1,y1,x2,y2, 0-based corners; NaN where the target cannot be seen
};

/// The true box of every frame, from frame 1 on; NaN where there is none.
///
/// error   Refusal (kBadData) naming file:line
std::vector<vision::Box> read_truth(const std::string& path, BoxFormat format, const vision::Box* init);

}  // namespace mote
