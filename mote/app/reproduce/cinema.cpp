#include "mote/app/reproduce/cinema.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/hand_over.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/reproduce/drawn_clip.hpp"
#include "mote/app/terminal/signals.hpp"
#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The plan of a run's options, which are words of `mote track`.
Plan plan_of(const Clip& clip, const Run& run) {
  std::vector<std::string> words = clip.options;
  words.insert(words.end(), run.options.begin(), run.options.end());
  try {
    return plan_from(arguments_from(run.where, track_command({}).options, words));
  } catch (const Refusal& refusal) {
    throw Refusal(ExitCode::kBadData, std::string(refusal.what()));
  }
}

/// The figures of a summary; NaN where it has none.
std::map<std::string, double, std::less<>> figures_in(const std::string& summary) {
  const auto json = nlohmann::json::parse(summary);
  const auto number = [](const nlohmann::json& from, const std::string& key) {
    return from.contains(key) && from[key].is_number() ? from[key].get<double>() : kNaN;
  };
  std::map<std::string, double, std::less<>> figures;
  for (const std::string key : {"overlap", "centre_error_px", "success", "lost_frames", "frames_per_second"})
    figures[key] = number(json, key);
  const auto& stages = json["particle_us"];
  for (const std::string stage : {"tp", "tw", "td"}) figures[stage + "_us"] = number(stages, stage);
  figures["tw_over_tp"] = figures["tw_us"] / figures["tp_us"];
  figures["tw_over_td"] = figures["tw_us"] / figures["td_us"];
  return figures;
}

}  // namespace

std::string data_folder(const std::string& item_file) {
  if (const char* data = std::getenv("MOTE_DATA"); data != nullptr && *data != '\0') return data;
  const fs::path checkout = fs::absolute(item_file).parent_path().parent_path().parent_path();
  return (checkout.parent_path() / "shared/data").lexically_normal().string();
}

Cinema::Cinema(const Item& item)
    : paper_(item.paper),
      name_(item.name),
      clip_(*item.clip),
      figures_(item.figures),
      comparisons_(item.comparisons),
      data_(data_folder(item.file)) {
  for (const Run& run : item.runs) {
    const Plan plan = plan_of(clip_, run);
    benches_.push_back({run, plan.seed, run.number > 0 ? run.number : static_cast<int>(plan.particles)});
  }
}

std::string Cinema::missing() const {
  if (clip_.drawn()) return "";
  std::error_code unknown;
  for (const std::string& file : {clip_.video, clip_.truth})
    if (const fs::path path = fs::path(data_) / file; !fs::exists(path, unknown)) return path.string();
  return "";
}

std::vector<std::string> Cinema::runs_of(const Comparison& c, std::size_t side) const {
  if (c.kind != Comparison::Kind::kParticlesEnough) return {c.runs[side]};
  std::vector<std::string> runs;
  for (const Bench& bench : benches_)
    if (bench.run.series == c.runs[side]) runs.push_back(bench.run.name);
  return runs;
}

std::vector<double> Cinema::particles_of(const std::string& series) const {
  std::vector<double> all;
  for (const Bench& bench : benches_)
    if (bench.run.series == series) all.push_back(bench.particles);
  return all;
}

const Cinema::Bench& Cinema::bench_of(const std::string& run) const {
  return *std::find_if(benches_.begin(), benches_.end(), [&](const Bench& b) { return b.run.name == run; });
}

std::size_t Cinema::work() const {
  std::set<std::pair<std::string, int>> tracks;
  for (const Comparison& c : comparisons_)
    for (std::size_t side = 0; side < c.runs.size(); ++side)
      for (const std::string& run : runs_of(c, side))
        for (int repeat = 0; repeat < c.repeats; ++repeat) tracks.insert({run, repeat});
  const auto shown = [](const Figure& figure) { return !figure.frames.empty(); };
  return tracks.size() + static_cast<std::size_t>(std::count_if(figures_.begin(), figures_.end(), shown));
}

const Cinema::Reel& Cinema::reel(std::uint64_t repeat) {
  if (!scratch_) scratch_.emplace();
  const auto [found, fresh] = reels_.try_emplace(clip_.drawn() ? repeat : 0);
  if (!fresh) return found->second;
  if (!clip_.drawn()) {
    const fs::path data(data_);
    return found->second = {(data / clip_.video).string(), (data / clip_.truth).string(), clip_.init};
  }
  const fs::path folder = scratch_->path() / std::to_string(repeat);
  fs::create_directory(folder);
  const std::string init = draw_clip(folder, clip_.frames, clip_.seed + repeat);
  return found->second = {(folder / "f%04d.pgm").string(), (folder / "truth.csv").string(), init};
}

std::vector<std::string> Cinema::words(const Bench& bench, std::uint64_t repeat) {
  const Reel& from = reel(repeat);
  std::vector<std::string> all{"track",   from.video, "--init",   from.init,
                               "--truth", from.truth, "--frames", std::to_string(clip_.frames)};
  all.insert(all.end(), clip_.options.begin(), clip_.options.end());
  all.insert(all.end(), bench.run.options.begin(), bench.run.options.end());
  for (const std::string& word : {std::string("--particles"), std::to_string(bench.particles), std::string("--seed"),
                                  std::to_string(bench.seed + repeat)})
    all.push_back(word);
  return all;
}

void Cinema::run_words(const std::vector<std::string>& words) const {
  if (stop_flag()) throw Refusal(ExitCode::kInterrupted, "mote reproduce: interrupted; no file was written.");
  const OutsideEnd end = run_tracker(words);
  if (end.code == 0) return;
  const auto code = end.code == 4 || end.code == 130 ? static_cast<ExitCode>(end.code) : ExitCode::kOutsideTool;
  std::string said = end.err.substr(0, end.err.find_last_not_of('\n') + 1);
  said.erase(0, said.rfind('\n') + 1);  // its last line: notes stand before
  throw Refusal(code, fmt::format("{} {}: {}", paper_, name_, said.empty() ? "mote-track failed." : said));
}

const TrackRow& Cinema::track(const std::string& run, std::uint64_t repeat, const std::function<void()>& ran) {
  const auto [found, fresh] = rows_.try_emplace({run, repeat});
  if (!fresh && !found->second.figures.empty()) return found->second;
  const Bench& bench = bench_of(run);
  std::vector<std::string> all = words(bench, repeat);
  const std::string summary = scratch_->file("summary.json");
  all.insert(all.end(), {"--summary", summary});
  run_words(all);
  ran();
  return found->second = {run, bench.run.series, bench.particles, repeat, figures_in(read_text(summary))};
}

std::vector<double> Cinema::sample(const Comparison& c, std::uint64_t repeat, std::size_t side,
                                   const std::function<void()>& ran) {
  const std::string key = c.kind == Comparison::Kind::kTrack ? c.key : "centre_error_px";
  std::vector<double> values;
  for (const std::string& run : runs_of(c, side)) values.push_back(track(run, repeat, ran).figures.find(key)->second);
  return values;
}

report::Picture Cinema::picture(const Figure& figure, const std::function<void()>& ran) {
  const std::string& run = figure.runs.front();
  const Bench& bench = bench_of(run);
  std::vector<std::string> all = words(bench, 0);
  const std::string sheet = scratch_->file("sheet.jpg");
  all.insert(all.end(), {"--sheet", sheet, "--sheet-frames", fmt::format("{}", fmt::join(figure.frames, ","))});
  run_words(all);
  ran();
  return {fmt::format("{} {}: {}", paper_, name_, figure.title), bytes_of(sheet)};
}

std::vector<TrackRow> Cinema::rows() const {
  std::vector<TrackRow> all;
  for (const Bench& bench : benches_)
    for (const auto& [key, row] : rows_)
      if (key.first == bench.run.name && !row.figures.empty()) all.push_back(row);
  return all;
}

}  // namespace mote::reproduce
