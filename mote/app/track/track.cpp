#include "mote/app/track/track.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>

#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/app/terminal/signals.hpp"
#include "mote/app/track/boxes_file.hpp"
#include "mote/app/track/outputs.hpp"
#include "mote/app/track/pursuit.hpp"
#include "mote/vision/detector.hpp"
#include "mote/vision/frames.hpp"

namespace mote {
namespace {

using namespace vision;

/// The four numbers of --init.
std::optional<Box> box_from(const Arguments& arguments) {
  if (!arguments.given("--init")) return std::nullopt;
  const std::string given = arguments.text("--init");
  std::vector<double> numbers;
  for (const std::string_view part : parts_of(given, ',')) numbers.push_back(number_in(part).value_or(kNaN));
  const auto finite = [](double n) { return std::isfinite(n); };
  if (numbers.size() != 4 || !std::all_of(numbers.begin(), numbers.end(), finite) || numbers[2] < 4 || numbers[3] < 4)
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--init", "x,y,w,h in pixels, w and h at least 4",
                                        in_quotes(given), "Pass, for example, --init 70,51,107,87."});
  return Box{numbers[0], numbers[1], numbers[2], numbers[3]};
}

TrackerOptions options_from(const Arguments& arguments) {
  TrackerOptions options;
  options.plan = plan_from(arguments);
  if (is_gaussian(options.plan.filter))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--filter", "a filter of particles",
                                        std::string(name_of(options.plan.filter)) +
                                            ", which linearises the observation: a picture has no slope",
                                        "Pass --filter sisr."});
  if (options.plan.engine != Engine::kFastest && options.plan.engine != Engine::kReference)
    throw Refusal(
        ExitCode::kWrongUse,
        {arguments.where(), "--engine", "reference: a picture's likelihood is no arithmetic on vectors of particles",
         std::string(name_of(options.plan.engine)), "Leave it out; the weights are vectors over pixels anyway."});
  options.states = static_cast<States>(arguments.choice("--states", {"location", "velocity", "scale", "affine"}));
  options.motion = static_cast<MotionKind>(arguments.choice("--motion", {"walk", "second", "adaptive"}));
  options.likelihood =
      likelihood_of(static_cast<Fit>(arguments.choice("--likelihood", {"fused", "mixture", "distance"})));
  options.adapt = arguments.choice("--particle-count", {"adaptive", "fixed"}) == 0;
  return options;
}

std::optional<Detector> detector_from(const Arguments& arguments, bool init) {
  const bool asked = arguments.given("--detect");
  if (!asked && arguments.given("--detector"))
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), "--detector", "--detect beside it", "none", "Pass --detect."});
  if (!asked && !init && !arguments.given("--show"))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--init", "a first box, or --detect", "neither",
                                        "Pass --init x,y,w,h or --detect, or --show to draw a box with the mouse."});
  if (!asked) return std::nullopt;
  const std::string name = arguments.text("--detector");
  return name == "people" ? Detector::people() : Detector::from_file(name);
}

/// The box that the user draws on the first frame.
Box drawn_box(const Arguments& arguments, const Screen& screen) {
  return screen.choose(open_frames(arguments.text("VIDEO"))->next().value());
}

/// How many frames are tracked at most.
std::size_t most_frames(const Arguments& arguments) {
  constexpr long long kMost = 1'000'000'000;
  return static_cast<std::size_t>(arguments.given("--frames") ? arguments.integer("--frames", 1, kMost) : kMost);
}

/// Tracks until the frames end or are enough, the program is stopped or a frame is bad; then says what was wrong,
/// unless it was so from the start: what was tracked is to be written first.
std::optional<Refusal> track_all(Frames& frames, std::size_t most, Pursuit& run, TrackOutputs& outputs,
                                 const std::atomic<bool>& stop) {
  Progress progress("frames");
  try {
    while (!stop && run.record().tracks.size() < most) {
      const auto frame = frames.next();
      if (!frame) {
        if (!frames.note().empty()) run.record().notes.push_back(frames.note());
        break;
      }
      run.step(*frame);
      outputs.add(*frame, run);
      const std::size_t number = run.record().tracks.size();
      progress.update(number, std::clamp(frames.count(), number, most));
    }
  } catch (const Refusal& refusal) {
    if (run.record().tracks.empty()) throw;
    return refusal;
  }
  return std::nullopt;
}

}  // namespace

ExitCode run_track(const Arguments& arguments) {
  const std::atomic<bool>& stop = stop_flag();
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::setNumThreads(1);  // the library's own threads share out the particles; nobody else's order of work counts
  const TrackerOptions options = options_from(arguments);
  std::optional<Box> init = box_from(arguments);
  auto detector = detector_from(arguments, init.has_value());
  const BoxFormat format = static_cast<BoxFormat>(arguments.choice("--truth-format", {"auto", "boxes", "otb", "tld"}));
  const std::size_t most = most_frames(arguments);
  const auto frames = open_frames(arguments.text("VIDEO"));
  TrackOutputs outputs(arguments, *frames, most);
  const bool drawn = !init && !detector;
  if (drawn) init = drawn_box(arguments, *outputs.screen());
  Pursuit run(arguments.where(), options, init, std::move(detector));
  if (drawn)
    run.record().notes.push_back(
        fmt::format("The box was drawn: --init {},{},{},{}", init->x, init->y, init->w, init->h));
  run.record().video = arguments.text("VIDEO");
  run.record().command = arguments.command_line();
  if (arguments.given("--truth"))
    run.record().truth = read_truth(arguments.text("--truth"), format, init ? &*init : nullptr);
  for (const std::string& note : notes_on_unread(arguments, options.plan)) fmt::print(stderr, "{}\n", printable(note));
  std::optional<Refusal> fault = track_all(*frames, most, run, outputs, stop);
  if (stop)
    fault.emplace(ExitCode::kInterrupted, fmt::format("{}: interrupted after {} frames, which were written.",
                                                      arguments.where(), run.record().tracks.size()));
  outputs.commit(run.finished());
  if (fault) throw Refusal(*fault);
  return ExitCode::kDone;
}

}  // namespace mote
