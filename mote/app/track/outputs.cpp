#include "mote/app/track/outputs.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/files/text.hpp"
#include "mote/app/track/boxes_file.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using namespace vision;

nlohmann::json summary_of(const TrackRecord& record) {
  const FrameTimes frames = frame_times_ms(record);
  const ParticleTimes times = particle_times_us(record);
  nlohmann::json json{{"video", record.video},
                      {"filter", name_of(record.plan.filter)},
                      {"particles", record.plan.particles},
                      {"seed", record.plan.seed},
                      {"threads", record.plan.threads},
                      {"frames", record.tracks.size()},
                      {"targets", record.targets},
                      {"frames_per_second", frame_rate(record)},
                      {"frame_ms", {{"p50", frames.p50}, {"p99", frames.p99}, {"max", frames.max}}},
                      {"particle_us", {{"tp", times.tp}, {"tw", times.tw}, {"td", times.td}}},
                      {"lost_frames", std::count_if(record.tracks.begin(), record.tracks.end(),
                                                    [](const Track& t) { return t.lost; })}};
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
             s["particle_us"]["tw"].get<double>());
  for (const std::string& loss : losses(record)) fmt::print("without the target: {}\n", loss);
  if (s.contains("overlap"))
    fmt::print("mean overlap {:.3f}, centre error {:.2f} px, success at 0.5 {:.3f}\n", s["overlap"].get<double>(),
               s["centre_error_px"].get<double>(), s["success"].get<double>());
}

/// Keeps whatever the command reads from being written over.
void protect_inputs(OutputSet& set, const Arguments& arguments, const Frames& frames) {
  set.protect(arguments.text("--truth"));
  if (arguments.given("--detector")) set.protect(arguments.text("--detector"));
  for (const std::string& file : frames.files()) set.protect(file);
}

/// The numbers of --sheet-frames.
std::vector<std::size_t> sheet_frames(const Arguments& arguments) {
  constexpr long long kMost = 1'000'000'000;
  const std::string given = arguments.text("--sheet-frames");
  std::vector<std::size_t> numbers;
  for (const std::string_view part : parts_of(given, ',')) {
    const auto number = integer_in(part);
    if (!number || *number < 1 || *number > kMost)
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--sheet-frames", "numbers of frames from 1, by commas",
                                          in_quotes(given), "Pass --sheet-frames 1,4,8,12,16,20."});
    numbers.push_back(static_cast<std::size_t>(*number));
  }
  return numbers;
}

/// The format that a sheet's name asks for.
std::string sheet_ending(const Arguments& arguments) {
  const std::string path = arguments.text("--sheet");
  for (const std::string ending : {".png", ".jpg"})
    if (path.ends_with(ending)) return ending;
  throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--sheet", "a name that ends in .png or .jpg", in_quotes(path),
                                      "Pass --sheet frames.png."});
}

}  // namespace

TrackOutputs::TrackOutputs(const Arguments& arguments, const Frames& frames, std::size_t most) {
  constexpr std::size_t kMostAtOnce = 100'000;  // a count may be a wild guess
  protect_inputs(set_, arguments, frames);
  boxes_ = set_.open(arguments.text("--out"));
  summary_ = set_.open(arguments.text("--summary"));
  report_ = set_.open(arguments.text("--report"));
  sheet_file_ = set_.open(arguments.text("--sheet"));
  if (sheet_file_ != nullptr) {
    sheet_ending_ = sheet_ending(arguments);
    sheet_.emplace(sheet_frames(arguments));
  }
  if (arguments.given("--video")) {
    film_.emplace(arguments.text("--video"), frames.rate());
    claim_pictures(film_->pictures() ? std::min({most, frames.count(), kMostAtOnce}) : 1);
  }
  if (boxes_ != nullptr) boxes_->write(boxes_header());
  if (arguments.given("--show")) screen_.emplace(arguments.where());
}

void TrackOutputs::claim_pictures(std::size_t number) {
  while (reserved_ < number) set_.reserve(film_->file_of(++reserved_));
}

void TrackOutputs::add(const cv::Mat& frame, Pursuit& run) {
  const std::size_t number = run.record().tracks.size();
  const Track& track = run.record().tracks.back();
  if (boxes_ != nullptr) boxes_->write(boxes_line(number, track));
  const bool on_sheet = sheet_ && sheet_->wants(number);
  if (!film_ && !screen_ && !on_sheet) return;
  const auto& truth = run.record().truth;
  const cv::Mat drawn =
      annotated(frame, track, run.first(), number, number <= truth.size() ? &truth[number - 1] : nullptr);
  if (on_sheet) sheet_->add(number, drawn);
  if (film_) {
    if (film_->pictures()) claim_pictures(number);
    film_->add(drawn);
  }
  if (screen_) screen_->show(drawn);
}

void TrackOutputs::commit(const TrackRecord& record) {
  report::Page page = track_page(record);
  if (sheet_) {
    const std::string picture = sheet_->picture(sheet_ending_);
    if (!picture.empty()) page.pictures.push_back({"Frames", picture});
    if (picture.empty()) fmt::print(stderr, "The sheet is empty: none of its frames was tracked.\n");
    sheet_file_->write(picture);
  }
  if (summary_ != nullptr) summary_->write(summary_of(record).dump(2) + "\n");
  if (report_ != nullptr) report_->write(report::html(page));
  if (film_) film_->commit();
  set_.commit();
  if (!set_.on_standard_output()) print_summary(record);
  for (const std::string& note : record.notes) fmt::print(stderr, "{}\n", printable(note));
}

}  // namespace mote
