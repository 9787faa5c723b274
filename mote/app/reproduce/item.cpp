#include "mote/app/reproduce/item.hpp"

#include <algorithm>
#include <filesystem>
#include <span>

#include <fmt/format.h>

#include "mote/app/reproduce/fields.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

using Kind = Comparison::Kind;

constexpr std::int64_t kMostSteps = 1'000'000;
constexpr std::int64_t kMostRepeats = 10'000;

/// Kinds in the order of the enumeration.
constexpr std::array<std::string_view, 18> kKinds{
    "mean-difference", "mean-spread",      "rmse",    "normalised-error", "final-bias",    "reference-error",
    "recovered",       "evidence-spread",  "summary", "resample-error",   "resample-time", "resample-cost",
    "track",           "particles-enough", "cluster", "circuit",          "design",        "analog"};
constexpr std::array<std::string_view, 3> kUnits{"standard-error", "posterior-sd", "absolute"};
constexpr std::array<std::string_view, 2> kMiddles{"mean", "median"};

bool reads_state(Kind kind) { return kind < Kind::kEvidenceSpread; }
bool averages(Kind kind) {
  return kind == Kind::kRmse || (kind >= Kind::kFinalBias && kind <= Kind::kRecovered) ||
         (kind >= Kind::kSummary && kind <= Kind::kTrack);
}

Source simulated_from(Fields fields) {
  Source source{fields.where(), fields.text("model"), fields.texts("set")};
  source.steps = static_cast<int>(fields.integer("steps", 1, kMostSteps));
  source.seed = static_cast<std::uint64_t>(fields.integer("seed", 0, INT64_MAX / 2, 1));
  source.columns = static_cast<int>(fields.integer("columns", 1, 4096, 1));
  fields.finish();
  return source;
}

/// Files are found beside the item.
Source data_from(Fields fields, const std::string& path) {
  Source source{fields.where(), fields.text("model"), fields.texts("set")};
  const auto folder = std::filesystem::path(path).parent_path();
  source.observations = (folder / fields.text("observations")).string();
  if (fields.has("truth")) source.truth = (folder / fields.text("truth")).string();
  fields.text_or("truth", "");
  fields.finish();
  return source;
}

WeightSource weights_from(Fields fields) {
  WeightSource source;
  source.particles = static_cast<std::size_t>(fields.integer("particles", 2, 1'000'000, 1000));
  source.ess = fields.numbers("ess");
  const auto inside = [&](double e) { return e * static_cast<double>(source.particles) >= 1.5 && e <= 0.99; };
  if (source.ess.empty() || !std::all_of(source.ess.begin(), source.ess.end(), inside))
    fields.refuse("ess",
                  fmt::format("a list of shares of N from {:g} to 0.99", 1.5 / static_cast<double>(source.particles)));
  source.seed = static_cast<std::uint64_t>(fields.integer("seed", 0, INT64_MAX / 2, 1));
  fields.finish();
  return source;
}

Clip clip_from(Fields fields) {
  Clip clip{fields.where(), fields.text("video"), fields.text("truth"), fields.text("init")};
  clip.frames = static_cast<int>(fields.integer("frames", 2, kMostSteps));
  clip.options = fields.texts("options");
  fields.finish();
  return clip;
}

Clip drawn_from(Fields fields) {
  Clip clip{fields.where(), "", ""};
  clip.frames = static_cast<int>(fields.integer("frames", 2, 10'000));
  clip.seed = static_cast<std::uint64_t>(fields.integer("seed", 0, INT64_MAX / 2, 1));
  clip.options = fields.texts("options");
  fields.finish();
  return clip;
}

std::vector<std::string> options_from(Fields fields) {
  std::vector<std::string> options = fields.texts("options");
  fields.finish();
  return options;
}

AnalogSource analog_from(Fields fields) {
  AnalogSource source{fields.where(), fields.text("command"), fields.texts("options")};
  fields.finish();
  return source;
}

/// The level of a figure or comparison: one of the item's.
double level_from(Fields& fields, const WeightSource& weights) {
  const auto level = fields.number("ess");
  if (!level || std::find(weights.ess.begin(), weights.ess.end(), *level) == weights.ess.end())
    fields.refuse("ess", fmt::format("one of {}", fmt::join(weights.ess, ", ")));
  return *level;
}

/// Positive whole numbers, each above the one before; none without the key.
std::vector<int> rising(Fields& fields, std::string_view key) {
  std::vector<int> list;
  for (const double number : fields.numbers(key)) {
    if (number < 1 || number > 1e6 || number != static_cast<int>(number) || (!list.empty() && number <= list.back()))
      fields.refuse(key, "a list of whole numbers from 1 on, rising");
    list.push_back(static_cast<int>(number));
  }
  return list;
}

/// The run of a table, or a run for each number of its list: of particles on a clip, of an option's values else.
std::vector<Run> runs_from(Fields fields, const Item& item) {
  Run run{fields.where(), fields.text("name"), fields.texts("options"), {}};
  const bool filters = !item.clip && !item.cluster && !item.design && !item.analog;
  if (filters) run.settings = fields.texts("set");
  if (filters && !item.weights) run.circuit = fields.yes("circuit");
  if (filters && !item.weights) run.analog = fields.yes("analog");
  if (run.circuit && run.analog) fields.refuse("analog", "a run without circuit = true");
  const std::string swept = filters ? fields.text_or("sweep", "") : "";
  const std::vector<int> numbers = item.cluster || item.design || item.analog
                                       ? std::vector<int>{}
                                       : rising(fields, item.clip ? "particles" : "values");
  if (filters && swept.empty() != numbers.empty()) fields.refuse("sweep", "an option, and a list of its values");
  std::vector<Run> runs;
  for (const int number : numbers) {
    Run& one = runs.emplace_back(run);
    one.name = fmt::format("{} {}", run.name, number);
    one.series = run.name;
    one.number = number;
    one.sweep = swept;
    if (!swept.empty()) one.options.insert(one.options.end(), {swept, std::to_string(number)});
  }
  if (runs.empty()) runs.push_back(run);
  for (const Run& one : runs)
    if (std::any_of(item.runs.begin(), item.runs.end(), [&](const Run& r) { return slug(r.name) == slug(one.name); }))
      fields.refuse("name", "a name that no other run has");
  fields.finish();
  return runs;
}

void check_names(const Fields& fields, const std::vector<std::string>& names, const std::vector<Run>& runs,
                 std::string Run::*known = &Run::name) {
  for (const std::string& name : names)
    if (std::none_of(runs.begin(), runs.end(), [&](const Run& r) { return r.*known == name; }))
      fields.refuse("runs", known == &Run::name ? "names of the item's runs" : "names of runs with lists of particles");
}

void check_names_or_series(const Fields& fields, const std::vector<std::string>& names, const std::vector<Run>& runs) {
  for (const std::string& name : names)
    if (std::none_of(runs.begin(), runs.end(), [&](const Run& r) { return r.name == name || r.series == name; }))
      fields.refuse("runs", "names of the item's runs, or of series of them");
}

Figure figure_from(Fields fields, const Item& item) {
  Figure figure{fields.where(), fields.text("title")};
  if (item.weights) {
    figure.ess = level_from(fields, *item.weights);
  } else if (item.clip) {
    figure.frames = rising(fields, "frames");
  } else if (item.cluster) {
    figure.quantity = kClusterKeys[fields.choice("quantity", std::span(kClusterKeys).first(2))];
  } else if (item.design) {
    figure.quantity = kDesignFigures[fields.choice("quantity", kDesignFigures)];
    figure.repeats = static_cast<int>(fields.integer("most", 2, 10'000, 10));
  } else if (item.analog) {
    figure.quantity = fields.text("quantity");
  } else {
    figure.state = fields.text_or("state", "");
    figure.error = fields.yes("error");
    if (fields.has("against")) {
      figure.against = kAgainst[fields.choice("against", kAgainst)];
      figure.repeats = static_cast<int>(fields.integer("repeats", 2, kMostRepeats, 20));
    }
  }
  if (figure.error && figure.state.empty()) fields.refuse("error", "a state whose error is drawn");
  figure.runs = fields.texts("runs");
  if (!figure.against.empty()) {
    if (figure.state.empty()) fields.refuse("state", "the state whose error is drawn");
    check_names_or_series(fields, figure.runs, item.runs);
  } else {
    check_names(fields, figure.runs, item.runs, item.clip && figure.frames.empty() ? &Run::series : &Run::name);
  }
  if (!figure.frames.empty() && figure.runs.size() != 1) fields.refuse("runs", "the one run whose frames are shown");
  fields.finish();
  return figure;
}

void read_runs(Fields& fields, const std::vector<Run>& runs, Comparison& c) {
  c.runs = fields.texts("runs");
  const std::size_t least = c.kind == Kind::kRecovered ? 3 : c.kind == Kind::kMeanDifference ? 2 : 1;
  if (c.runs.size() < least || c.runs.size() > std::max<std::size_t>(least, 2))
    fields.refuse("runs", least == 3   ? "a list of three runs"
                          : least == 2 ? "a list of two runs"
                                       : "a list of one run, or of two");
  check_names(fields, c.runs, runs, c.kind == Kind::kParticlesEnough ? &Run::series : &Run::name);
}

void read_condition(Fields& fields, Comparison& c) {
  c.at_least = fields.number("at_least");
  c.at_most = fields.number("at_most");
  c.within = fields.number("within");
  if (fields.is_number("paper")) {
    c.paper = *fields.number("paper");
  } else if (auto text = fields.text_or("paper", ""); !text.empty()) {
    c.paper = std::move(text);
  }
  const double* printed = std::get_if<double>(&c.paper);
  if (c.within && (*c.within < 0 || printed == nullptr || *printed == 0))
    fields.refuse("within", "a share of a printed number other than 0");
  if (!c.at_least && !c.at_most && !c.within) fields.refuse("at_most", "at_least, at_most or within: when it holds");
}

/// The kind, of those that the item's source can answer.
Kind kind_from(Fields& fields, const Item& item) {
  const std::size_t first = static_cast<std::size_t>(item.weights   ? Kind::kResampleError
                                                     : item.clip    ? Kind::kTrack
                                                     : item.cluster ? Kind::kCluster
                                                     : item.design  ? Kind::kDesign
                                                     : item.analog  ? Kind::kAnalog
                                                                    : Kind{});
  const std::size_t count = item.weights ? 3 : item.clip ? 2 : item.cluster || item.design || item.analog ? 1 : 9;
  const auto known = std::span(kKinds).subspan(first, count);
  if (!fields.has("kind")) fields.refuse("kind", fmt::format("one of {}", fmt::join(known, ", ")));
  if (first == 0 && fields.text_or("kind", "") == kKinds[static_cast<std::size_t>(Kind::kCircuit)])
    return Kind::kCircuit;
  return static_cast<Kind>(fields.choice("kind", known) + first);
}

Comparison comparison_from(Fields fields, const Item& item) {
  Comparison c;
  c.where = fields.where();
  c.name = fields.text("name");
  c.kind = kind_from(fields, item);
  read_runs(fields, item.runs, c);
  if (item.weights) c.ess = level_from(fields, *item.weights);
  if (reads_state(c.kind)) c.state = fields.text("state");
  if (c.kind == Kind::kSummary) c.key = kSummaryKeys[fields.choice("key", kSummaryKeys)];
  if (c.kind == Kind::kTrack) c.key = kTrackKeys[fields.choice("key", kTrackKeys)];
  if (c.kind == Kind::kParticlesEnough) c.slack = fields.number("slack").value_or(0.1);
  if (c.kind == Kind::kMeanDifference) c.unit = static_cast<Comparison::Unit>(fields.choice("unit", kUnits));
  if (averages(c.kind)) c.median = fields.choice("over", kMiddles) == 1;
  if (c.kind == Kind::kCluster) {
    c.key = kClusterKeys[fields.choice("key", kClusterKeys)];
    c.cast.proposers = static_cast<std::size_t>(fields.integer("proposers", 1, 64, 1));
    c.cast.weighers = static_cast<std::size_t>(fields.integer("weighers", 1, 64, 1));
  }
  if (c.kind == Kind::kCircuit) {
    c.key = kCircuitKeys[fields.choice("key", kCircuitKeys)];
    if (c.key == "milliseconds") c.mhz = fields.number("mhz").value_or(0);
    if (c.mhz < 0 || (c.mhz == 0 && c.key == "milliseconds" && fields.has("mhz")))
      fields.refuse("mhz", "a number above 0");
    for (const std::string& name : c.runs)
      if (std::none_of(item.runs.begin(), item.runs.end(), [&](const Run& r) { return r.name == name && r.circuit; }))
        fields.refuse("runs", "names of runs with circuit = true");
  }
  if (c.kind == Kind::kDesign || c.kind == Kind::kAnalog) c.key = fields.text("key");
  c.repeats = has_chance(c) ? static_cast<int>(fields.integer("repeats", 2, kMostRepeats, 20)) : 1;
  read_condition(fields, c);
  c.note = fields.text_or("note", "");
  fields.finish();
  return c;
}

std::string_view meaning_of_key(const std::string& key) {
  if (key == "speedup") return "Speed-up over the first setting";
  if (key == "seconds_over_law") return "Time over what the latency law says";
  if (key == "speedup_over_law") return "Speed-up over the first setting, over what the latency law says of it";
  if (key == "speedup_over_most")
    return "Speed-up over the first setting, over the most that the stages' times allow, "
           "max(T_p, T) / max(T_p/R_p, T) with T = max(T_w/R_w, T_d)";
  return "Seconds of all steps";
}

}  // namespace

Item read_item(const std::string& path, const std::string& paper) {
  const toml::table root = parsed_toml(path);
  Fields fields(root, path);
  Item item;
  item.file = path;
  item.paper = paper;
  item.name = fields.text("item");
  item.title = fields.text("title");
  item.source = fields.text("source");
  item.printed = fields.text("printed");
  item.note = fields.text_or("note", "");
  int sources = 0;
  for (const char* table : {"simulate", "data", "weights", "clip", "drawn", "cluster", "design", "analog"})
    sources += fields.has(table);
  if (sources != 1)
    fields.refuse("simulate",
                  "one of the tables [simulate], [data], [weights], [clip], [drawn], [cluster], [design] and [analog]");
  if (fields.has("weights")) item.weights = weights_from(fields.table("weights"));
  if (fields.has("clip")) item.clip = clip_from(fields.table("clip"));
  if (fields.has("drawn")) item.clip = drawn_from(fields.table("drawn"));
  if (fields.has("cluster")) item.cluster = options_from(fields.table("cluster"));
  if (fields.has("design")) item.design = options_from(fields.table("design"));
  if (fields.has("analog")) item.analog = analog_from(fields.table("analog"));
  if (fields.has("data")) item.recording = data_from(fields.table("data"), path);
  if (fields.has("simulate")) item.recording = simulated_from(fields.table("simulate"));
  for (const Fields& table : fields.tables("run"))
    for (Run& run : runs_from(table, item)) item.runs.push_back(std::move(run));
  if (item.runs.empty()) fields.refuse("run", "at least one table [[run]]");
  for (const Fields& table : fields.tables("figure")) item.figures.push_back(figure_from(table, item));
  for (const Fields& table : fields.tables("compare")) item.comparisons.push_back(comparison_from(table, item));
  fields.finish();
  return item;
}

std::string meaning_of(const Comparison& c) {
  constexpr std::array<std::string_view, 3> kIn{
      ", in Monte-Carlo standard errors of that difference (1 = none to be seen)", ", in posterior deviations", ""};
  const std::string weights = fmt::format(", {} over weight vectors", kMiddles[c.median ? 1 : 0]);
  const std::string over = fmt::format(", {} over recordings", kMiddles[c.median ? 1 : 0]);
  switch (c.kind) {
    case Kind::kMeanDifference:
      return fmt::format(
          "Difference of means: RMS over time between the mean estimates of two runs, each averaged over "
          "the repeats on one recording{}",
          kIn[static_cast<std::size_t>(c.unit)]);
    case Kind::kMeanSpread:
      return "Deviation of the posterior mean: Monte-Carlo deviation over repeats on one recording, RMS over time";
    case Kind::kRmse:
      return "RMSE: root over time of the mean squared error to the truth" + over;
    case Kind::kNormalisedError:
      return "Error in deviations: RMS over time and recordings of (mean - truth) / posterior deviation (1 = exact)";
    case Kind::kFinalBias:
      return "Final bias: mean - truth at the last step" + over;
    case Kind::kReferenceError:
      return fmt::format(
          "Error to the posterior mean: mean square over time of mean - posterior mean, the exact one "
          "or that of a large run{}",
          over);
    case Kind::kRecovered:
      return fmt::format(
          "Recovered: (a - b) / (a - c) of the errors a, b, c to the posterior mean of three runs, mean squares over "
          "time{}",
          over);
    case Kind::kEvidenceSpread:
      return "Spread of the log evidence: its deviation over repeats on one recording (nat)";
    case Kind::kSummary:
      return "Figure of a run's summary" + over;
    case Kind::kResampleError:
      return "Error of resampling: mean square of resampled minus weighted mean, in exact variances of multinomial "
             "draws" +
             weights;
    case Kind::kResampleTime:
      return "Time of resampling: ns per draw" + weights;
    case Kind::kResampleCost:
      return "Cost of resampling: its error times its time" + weights;
    case Kind::kTrack:
      return fmt::format("Figure of a track, {} over filter seeds and drawn clips", kMiddles[c.median ? 1 : 0]);
    case Kind::kCluster:
      return fmt::format("{} on a simulated cluster, {} proposers, {} weighers", meaning_of_key(c.key),
                         c.cast.proposers, c.cast.weighers);
    case Kind::kCircuit:
      return fmt::format("Figure of a circuit: {}{}", c.key, c.mhz > 0 ? fmt::format(" at {:g} MHz", c.mhz) : "");
    case Kind::kDesign:
      return fmt::format("Value of a design, in the JSON of mote design optimise: {}", c.key);
    case Kind::kAnalog:
      return fmt::format("Value of analog circuits, in the JSON of the item's command: {}", c.key);
    case Kind::kParticlesEnough:
      return fmt::format(
          "Particles that are enough: the least number from which on the centre error, a mean over filter seeds and "
          "drawn clips, is at most {:g} % above that of the most particles tried",
          100 * c.slack);
  }
  return "";
}

std::string condition_of(const Comparison& c) {
  std::vector<std::string> parts;
  if (c.at_least && c.at_most) {
    parts.push_back(fmt::format("{:g} to {:g}", *c.at_least, *c.at_most));
  } else if (c.at_least) {
    parts.push_back(fmt::format("at least {:g}", *c.at_least));
  } else if (c.at_most) {
    parts.push_back(fmt::format("at most {:g}", *c.at_most));
  }
  if (c.within) parts.push_back(fmt::format("within {:g} % of the paper", 100 * *c.within));
  return fmt::format("{}", fmt::join(parts, " and "));
}

std::vector<std::string> merged(std::vector<std::string> settings, const std::vector<std::string>& changes) {
  for (const std::string& change : changes) {
    const std::string key = change.substr(0, change.find('=') + 1);
    std::erase_if(settings, [&](const std::string& setting) { return setting.starts_with(key); });
  }
  settings.insert(settings.end(), changes.begin(), changes.end());
  return settings;
}

std::string slug(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const char low = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if ((low >= 'a' && low <= 'z') || (low >= '0' && low <= '9')) {
      out += low;
    } else if (!out.empty() && out.back() != '-') {
      out += '-';
    }
  }
  while (out.ends_with('-')) out.pop_back();
  return out;
}

}  // namespace mote::reproduce
