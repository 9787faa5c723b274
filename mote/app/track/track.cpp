#include "mote/app/track/track.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/app/terminal/signals.hpp"
#include "mote/app/track/boxes_file.hpp"
#include "mote/app/track/plot.hpp"
#include "mote/app/track/pursuit.hpp"
#include "mote/app/track/screen.hpp"
#include "mote/vision/detector.hpp"
#include "mote/vision/drawing.hpp"
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
  if (options.plan.engine == Engine::kSimd || options.plan.engine == Engine::kMpi)
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
  if (!asked && !init)
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--init", "a first box, or --detect", "neither",
                                        "Pass --init x,y,w,h or --detect."});
  if (!asked) return std::nullopt;
  const std::string name = arguments.text("--detector");
  return name == "people" ? Detector::people() : Detector::from_file(name);
}

nlohmann::json summary_of(const TrackRecord& record) {
  const double particles = std::max(1.0, static_cast<double>(record.times.particles));
  nlohmann::json json{
      {"video", record.video},
      {"filter", name_of(record.plan.filter)},
      {"particles", record.plan.particles},
      {"seed", record.plan.seed},
      {"frames", record.tracks.size()},
      {"targets", record.targets},
      {"seconds", record.seconds},
      {"frames_per_second", static_cast<double>(record.tracks.size()) / record.seconds},
      {"lost_frames", std::count_if(record.tracks.begin(), record.tracks.end(), [](const Track& t) { return t.lost; })},
      {"propose_us", 1e6 * record.times.propose / particles},
      {"weigh_us", 1e6 * record.times.weigh / particles},
      {"select_us", 1e6 * record.times.select / particles}};
  if (record.truth.empty()) return json;
  const TrackScore score = score_track(boxes_of(record), record.truth);
  json["overlap"] = score.overlap;
  json["centre_error_px"] = score.centre_error_px;
  json["success"] = score.success;
  return json;
}

void print_summary(const TrackRecord& record) {
  const nlohmann::json s = summary_of(record);
  fmt::print("{}  {}  N = {}  seed {}\n", printable(record.video), name_of(record.plan.filter), record.plan.particles,
             record.plan.seed);
  fmt::print("{} frames, {} target{}, {:.3g} frames/s, a particle weighs {:.2f} us\n", record.tracks.size(),
             record.targets, record.targets == 1 ? "" : "s", s["frames_per_second"].get<double>(),
             s["weigh_us"].get<double>());
  for (const std::string& loss : losses(record)) fmt::print("without the target: {}\n", loss);
  if (s.contains("overlap"))
    fmt::print("mean overlap {:.3f}, centre error {:.2f} px, success at 0.5 {:.3f}\n", s["overlap"].get<double>(),
               s["centre_error_px"].get<double>(), s["success"].get<double>());
}

/// What follows the last frame that could be tracked: everything is written, then the fault is told.
struct Outputs {
  OutputSet set;
  Output *boxes, *summary, *report;
  std::optional<Film> film;
  std::optional<Screen> screen;

  Outputs(const Arguments& arguments, double rate) {
    for (const std::string name : {"--truth", "VIDEO"}) set.protect(arguments.text(name));
    boxes = set.open(arguments.text("--out"));
    summary = set.open(arguments.text("--summary"));
    report = set.open(arguments.text("--report"));
    if (arguments.given("--video")) film.emplace(arguments.text("--video"), rate);
    if (boxes != nullptr) boxes->write(boxes_header());
    if (arguments.given("--show")) screen.emplace(arguments.where());
  }
  /// Writes and shows a frame that was tracked.
  void add(const cv::Mat& frame, Pursuit& run) {
    const std::size_t number = run.record().tracks.size();
    const Track& track = run.record().tracks.back();
    if (boxes != nullptr) boxes->write(boxes_line(number, track));
    if (!film && !screen) return;
    const auto& truth = run.record().truth;
    const cv::Mat drawn =
        annotated(frame, track, run.first(), number, number <= truth.size() ? &truth[number - 1] : nullptr);
    if (film) film->add(drawn);
    if (screen) screen->show(drawn);
  }
  void commit(const TrackRecord& record) {
    if (summary != nullptr) summary->write(summary_of(record).dump(2) + "\n");
    if (report != nullptr) report->write(report::html(track_page(record)));
    if (film) film->commit();
    set.commit();
    if (!set.on_standard_output()) print_summary(record);
  }
};

/// Tracks until the frames end, the program is stopped or a frame is bad; then says what was wrong, unless it was so
/// from the start: what was tracked is to be written first.
std::optional<Refusal> track_all(Frames& frames, Pursuit& run, Outputs& outputs, const std::atomic<bool>& stop) {
  Progress progress("frames");
  try {
    while (!stop) {
      const auto frame = frames.next();
      if (!frame) break;
      run.step(*frame);
      outputs.add(*frame, run);
      const std::size_t number = run.record().tracks.size();
      progress.update(number, std::max(number, frames.count()));
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
  const std::optional<Box> init = box_from(arguments);
  Pursuit run(arguments.where(), options, init, detector_from(arguments, init.has_value()));
  run.record().video = arguments.text("VIDEO");
  run.record().command = arguments.command_line();
  const BoxFormat format = static_cast<BoxFormat>(arguments.choice("--truth-format", {"auto", "boxes", "otb", "tld"}));
  if (arguments.given("--truth"))
    run.record().truth = read_truth(arguments.text("--truth"), format, init ? &*init : nullptr);
  const auto frames = open_frames(arguments.text("VIDEO"));
  Outputs outputs(arguments, frames->rate());
  for (const std::string& note : notes_on_unread(arguments, options.plan)) fmt::print(stderr, "{}\n", printable(note));
  std::optional<Refusal> fault = track_all(*frames, run, outputs, stop);
  if (stop)
    fault.emplace(ExitCode::kInterrupted, fmt::format("{}: interrupted after {} frames, which were written.",
                                                      arguments.where(), run.record().tracks.size()));
  outputs.commit(run.finished());
  if (fault) throw Refusal(*fault);
  return ExitCode::kDone;
}

}  // namespace mote
