#include <fmt/format.h>

#include "mote/app/commands/command.hpp"
#include "mote/app/commands/plan_options.hpp"

namespace mote {
namespace {

const std::string kCodes =
    "Exit codes: 0 done, 2 wrong use, 3 bad data, 4 collapsed, 5 outside tool, 6 cannot write, 130 interrupted.";

/// The filter options, with what a tracker needs by default: fewer particles, since each weighs a picture, and no end
/// when all weights vanish, since a target may hide.
std::vector<OptionSpec> filter_options() {
  std::vector<OptionSpec> options = plan_options();
  for (OptionSpec& option : options) {
    if (option.flags == "-n,--particles") option.fallback = "600";
    if (option.flags == "--on-collapse") option.fallback = "keep";
  }
  return options;
}

}  // namespace

Command track_command(std::function<ExitCode(const Arguments&)> track) {
  std::vector<OptionSpec> options{
      {"--init", "X,Y,W,H", "", "box of the target in the first frame, px, 0-based corner; or pass --detect, or --show",
       "Target"},
      {"--detect", "", "", "find targets by a detector, at the start and when one is lost for long", "Target"},
      {"--detector", "NAME", "people", "people, or a file made by mote train", "Target"},
      {"--frames", "K", "", "track the first K frames only [all]", "Target"},
      {"--out", "FILE", "", "boxes as CSV, a line a frame; - is standard output [none]", "Output"},
      {"--summary", "FILE", "", "figures of the run as JSON [none]", "Output"},
      {"--video", "FILE", "", "annotated video (.mp4, .avi), or pictures (out%04d.png) [none]", "Output"},
      {"--sheet", "FILE", "", "some annotated frames side by side in one picture (.png, .jpg) [none]", "Output"},
      {"--sheet-frames", "LIST", "1,4,8,12,16,20", "the frames of the sheet", "Output"},
      {"--report", "FILE", "", "report with plots, one HTML file [none]", "Output"},
      {"--show", "", "",
       "show the frames while they are tracked (needs a display); without --init and --detect, first draw the box",
       "Output"},
      {"--truth", "FILE", "", "true boxes, to score against [none]", "Truth"},
      {"--truth-format", "FORMAT", "auto",
       "boxes (CSV as --out), otb (x,y,w,h a line, 1-based), tld (x1,y1,x2,y2 a line, 0-based), or auto: by the "
       "header, "
       "else whichever of otb and tld is nearer to --init",
       "Truth"},
      {"--states", "WHAT", "affine", "what moves: location, velocity, scale or affine", "Model"},
      {"--motion", "HOW", "adaptive",
       "walk, second (keeps its velocity), or adaptive (goes where the place filter says)", "Model"},
      {"--likelihood", "HOW", "fused",
       "fused (appearance, place and extent filters), mixture (appearance alone), or distance (to the template)",
       "Model"},
      {"--particle-count", "HOW", "adaptive", "adaptive (half when sure, twice after a doubt) or fixed", "Model"},
  };
  for (OptionSpec& option : filter_options()) options.push_back(std::move(option));
  return {"track",
          "Track a target through a video",
          {{"VIDEO", "a video file, a folder of pictures, or a pattern such as shot%04d.jpg"}},
          std::move(options),
          std::move(track),
          kCodes};
}

Command train_command(std::function<ExitCode(const Arguments&)> train) {
  return {"train",
          "Train a detector for mote track",
          {},
          {{"--positives", "FILE", "", "picture of 64 x 64 patches that show a target, in rows", "Data", true},
           {"--negatives", "FILE", "", "picture of 64 x 64 patches that show none, in rows", "Data", true},
           {"--scenes", "DIR", "",
            "pictures of any size, or a video, without targets, to look for hard negatives in; may be repeated [none]",
            "Data", true},
           {"--out", "FILE", "", "the detector, for mote track --detector; must be given", "Output"}},
          std::move(train),
          kCodes};
}

}  // namespace mote
