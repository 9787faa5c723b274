#include "mote/app/track/plot.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "mote/base/numbers.hpp"

namespace mote {
namespace {

using report::Chart;
using report::Fact;
using report::Series;

/// A value of every frame as a series.
template <class Value>
Series over_frames(const std::string& name, Series::Mark mark, std::size_t frames, Value value) {
  Series series{.name = name, .mark = mark};
  for (std::size_t k = 0; k < frames; ++k) {
    series.x.push_back(static_cast<double>(k + 1));
    series.y.push_back(value(k));
  }
  return series;
}

Chart chart_of(const std::string& title, const std::string& label, std::vector<Series> series) {
  return {.title = title, .x_label = "frame", .y_label = label, .series = std::move(series)};
}

template <class Value>
Chart box_chart(const TrackRecord& record, const std::string& title, Value value) {
  std::vector<Series> series{over_frames("estimate", Series::Mark::kLine, record.tracks.size(),
                                         [&](std::size_t k) { return value(record.tracks[k].box); })};
  if (!record.truth.empty())
    series.push_back(over_frames("truth", Series::Mark::kLine, std::min(record.truth.size(), record.tracks.size()),
                                 [&](std::size_t k) { return value(record.truth[k]); }));
  return chart_of(title, "px", std::move(series));
}

std::vector<Chart> truth_charts(const TrackRecord& record) {
  const std::size_t frames = std::min(record.truth.size(), record.tracks.size());
  const auto seen = [&](std::size_t k) {
    return !std::isnan(record.truth[k].x) && !std::isnan(record.tracks[k].box.x);
  };
  return {chart_of("Overlap with the truth", "intersection over union",
                   {over_frames("overlap", Series::Mark::kLine, frames,
                                [&](std::size_t k) {
                                  return seen(k) ? vision::overlap(record.tracks[k].box, record.truth[k]) : kNaN;
                                })}),
          chart_of("Centre error", "px", {over_frames("error", Series::Mark::kLine, frames, [&](std::size_t k) {
                     return seen(k) ? vision::centre_distance(record.tracks[k].box, record.truth[k]) : kNaN;
                   })})};
}

std::vector<Fact> facts_of(const TrackRecord& record) {
  const FrameTimes frames = frame_times_ms(record);
  const ParticleTimes times = particle_times_us(record);
  std::vector<Fact> facts{
      {"Video", record.video},
      {"Filter", std::string(name_of(record.plan.filter))},
      {"Particles", std::to_string(record.plan.particles)},
      {"Seed", std::to_string(record.plan.seed)},
      {"Frames", std::to_string(record.tracks.size())},
      {"Speed", fmt::format("{:.3g} frames/s", frame_rate(record))},
      {"A frame: half, 99 in 100, all within",
       fmt::format("{:.3g}, {:.3g}, {:.3g} ms", frames.p50, frames.p99, frames.max)},
      {"A particle's proposal, weight, selection",
       fmt::format("{:.2f}, {:.2f}, {:.2f} µs", times.tp, times.tw, times.td)},
      {"Frames without the target", std::to_string(std::count_if(record.tracks.begin(), record.tracks.end(),
                                                                 [](const auto& t) { return t.lost; }))}};
  if (record.truth.empty()) return facts;
  const TrackScore score = score_track(boxes_of(record), record.truth);
  facts.push_back({"Mean overlap", fmt::format("{:.3f}", score.overlap)});
  facts.push_back({"Mean centre error", fmt::format("{:.2f} px", score.centre_error_px)});
  facts.push_back({"Frames with overlap above 0.5", fmt::format("{:.1f} %", 100 * score.success)});
  return facts;
}

}  // namespace

std::vector<vision::Box> boxes_of(const TrackRecord& record) {
  std::vector<vision::Box> boxes;
  for (const vision::Track& track : record.tracks) boxes.push_back(track.box);
  return boxes;
}

FrameTimes frame_times_ms(const TrackRecord& record) {
  std::vector<double> sorted = record.frame_seconds;
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  const auto within = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return 1e3 * sorted[rank - 1];
  };
  return {within(0.5), within(0.99), within(1)};
}

double frame_rate(const TrackRecord& record) {
  const double seconds = std::accumulate(record.frame_seconds.begin(), record.frame_seconds.end(), 0.0);
  return static_cast<double>(record.tracks.size()) / seconds;
}

ParticleTimes particle_times_us(const TrackRecord& record) {
  const vision::StageTimes& times = record.times;
  const double per_particle = 1e6 / std::max(1.0, static_cast<double>(times.particles));
  return {times.propose * per_particle, times.weigh * per_particle, times.select * per_particle};
}

std::vector<std::string> losses(const TrackRecord& record) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < record.tracks.size();) {
    if (!record.tracks[k++].lost) continue;
    const std::size_t from = k;
    while (k < record.tracks.size() && record.tracks[k].lost) ++k;
    texts.push_back(from == k ? fmt::format("frame {}", k)
                              : fmt::format("frame {} to {} ({} frames)", from, k, k - from + 1));
  }
  return texts;
}

report::Page track_page(const TrackRecord& record) {
  report::Page page{.title = fmt::format("Track through {}", record.video)};
  page.summary =
      fmt::format("{} frames, {} target{}.", record.tracks.size(), record.targets, record.targets == 1 ? "" : "s");
  page.command = record.command;
  page.facts = facts_of(record);
  if (!record.truth.empty()) page.charts = truth_charts(record);
  const std::size_t frames = record.tracks.size();
  page.charts.push_back(chart_of(
      "Score", "0 = lost, 1 = sure",
      {over_frames("score", Series::Mark::kSteps, frames, [&](std::size_t k) { return record.tracks[k].score; })}));
  page.charts.push_back(box_chart(record, "Centre x", [](const vision::Box& b) { return b.centre_x(); }));
  page.charts.push_back(box_chart(record, "Centre y", [](const vision::Box& b) { return b.centre_y(); }));
  page.charts.push_back(box_chart(record, "Width", [](const vision::Box& b) { return b.w; }));
  page.charts.push_back(box_chart(record, "Height", [](const vision::Box& b) { return b.h; }));
  page.charts.push_back(
      chart_of("Particles", "particles", {over_frames("particles", Series::Mark::kSteps, frames, [&](std::size_t k) {
                 return static_cast<double>(record.tracks[k].particles);
               })}));
  for (const std::string& loss : losses(record)) page.notes.push_back("Without the target: " + loss + ".");
  for (const std::string& note : record.notes) page.notes.push_back(note);
  return page;
}

}  // namespace mote
