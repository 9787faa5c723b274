#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/inputs.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/words/study.hpp"
#include "mote/graph/print.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;

/// What the command finds out.
struct Found {
  graph::Recorded recorded;
  graph::Ranges ranges;
  std::optional<graph::Words> words;
  double fresh_ratio = 0;  ///< on recordings that the search has not seen
};

WordStudyDesign design_from(const Arguments& arguments) {
  WordStudyDesign design;
  design.particles = static_cast<std::size_t>(arguments.integer("--particles", 1, 1'000'000));
  design.steps = static_cast<Step>(arguments.integer("--steps", 1, 100'000));
  design.recordings = static_cast<std::size_t>(arguments.integer("--recordings", 1, 100'000));
  design.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 1'000'000'000));
  design.margin = arguments.number("--margin", 0, 100);
  design.search.budget = arguments.number("--budget", 0, 10);
  design.search.rounding = static_cast<graph::Rounding>(arguments.choice("--rounding", {"nearest", "truncate"}));
  return design;
}

Found found(const CatalogueModel& model, const WordStudyDesign& design, bool words) {
  const WordStudy study(model, design);
  Found found{study.recorded(), study.ranges(), {}, 0};
  if (!words) return found;
  const auto ratio = [&](const graph::FixedPoint& point) { return study.error_ratio(point); };
  const auto outputs = found.recorded.filter_outputs();
  found.words = graph::search_words(found.recorded.graph, outputs, found.ranges, ratio, design.search);
  found.fresh_ratio = WordStudy(model, design, design.recordings).error_ratio(found.words->point);
  return found;
}

std::string label(const Found& found, graph::Id id) {
  const graph::Vertex& v = found.recorded.graph[id];
  std::string text = v.op == graph::Op::kConstant ? fmt::format("{:.6g}", v.value)
                     : v.op == graph::Op::kInput  ? found.recorded.name_of(v)
                                                  : std::string(graph::name_of(v.op));
  for (const graph::Id arg : v.operands()) text += fmt::format(" v{}", arg);
  return text;
}

Json as_json(const Found& found) {
  const auto outputs = found.recorded.filter_outputs();
  const std::vector<bool> used = graph::reached(found.recorded.graph, outputs);
  Json json{{"operations", graph::operations(found.recorded.graph, outputs)}, {"vertices", Json::array()}};
  for (graph::Id id = 0; id < found.recorded.graph.size(); ++id) {
    if (!used[id]) continue;
    const graph::Interval& kept = found.ranges.kept[id];
    const graph::Interval& seen = found.ranges.seen[id];
    Json vertex{
        {"id", id}, {"what", label(found, id)}, {"seen", {seen.low, seen.high}}, {"range", {kept.low, kept.high}}};
    if (found.words) {
      const graph::Format& format = found.words->point.formats[id];
      vertex["format"] = {{"sign", format.sign}, {"integer", format.integer}, {"fraction", format.fraction}};
    }
    json["vertices"].push_back(vertex);
  }
  if (found.words)
    json["words"] = {{"ratio", found.words->ratio},
                     {"fresh_ratio", found.fresh_ratio},
                     {"within_budget", found.words->within_budget},
                     {"trials", found.words->trials},
                     {"bits", graph::total_bits(found.recorded.graph, outputs, found.words->point)},
                     {"twins", found.words->point.twins->name}};
  return json;
}

void print(const Found& found) {
  const auto outputs = found.recorded.filter_outputs();
  const std::vector<bool> used = graph::reached(found.recorded.graph, outputs);
  for (const auto& [name, count] : graph::operations(found.recorded.graph, outputs))
    fmt::print("{:>4} {}\n", count, name);
  fmt::print("\n{:<8}{:<30}{:>26}{:>26}{}\n", "vertex", "what", "seen", "range", found.words ? "    format  bits" : "");
  for (graph::Id id = 0; id < found.recorded.graph.size(); ++id) {
    if (!used[id]) continue;
    const auto shown = [](const graph::Interval& i) { return fmt::format("[{:.5g}, {:.5g}]", i.low, i.high); };
    fmt::print("{:<8}{:<30}{:>26}{:>26}", fmt::format("v{}", id), label(found, id), shown(found.ranges.seen[id]),
               shown(found.ranges.kept[id]));
    if (found.words)
      fmt::print("{:>10}{:>6}", found.words->point.formats[id].name(), found.words->point.formats[id].width());
    fmt::print("\n");
  }
  if (!found.words) return;
  fmt::print("\n{} bits in all; error {:.4f} of the double filter's, {:.4f} on fresh recordings; {} filter runs\n",
             graph::total_bits(found.recorded.graph, outputs, found.words->point), found.words->ratio,
             found.fresh_ratio, found.words->trials);
  if (!found.words->within_budget) fmt::print("no word length keeps the budget\n");
  fmt::print("operators computed by: {}\n", found.words->point.twins->name);
}

ExitCode run_graph(const Arguments& arguments) {
  const CatalogueEntry entry = find_model(arguments.text("MODEL"), arguments.where());
  const auto header = frame_header(arguments.integer("--columns", 1, 64));
  const auto model = entry.make(Settings(arguments.where(), arguments.list("--set")), header);
  const WordStudyDesign design = design_from(arguments);
  OutputSet outputs;
  protect_inputs(outputs, arguments, {});
  Output* dot = outputs.open(arguments.text("--dot"));
  Output* list = outputs.open(arguments.text("--list"));
  Output* json = outputs.open(arguments.text("--json"));
  const Found all = found(*model, design, arguments.given("--words"));
  if (dot != nullptr) dot->write(graph::as_dot(all.recorded));
  if (list != nullptr) list->write(graph::as_text(all.recorded));
  if (json != nullptr) json->write(as_json(all).dump(2) + "\n");
  outputs.commit();
  if (!outputs.on_standard_output()) print(all);
  return ExitCode::kDone;
}

}  // namespace

Command graph_command() {
  const std::string study = "Simulation";
  return {"graph",
          "Show a model as arithmetic: operations, ranges, word lengths",
          {{"MODEL", "a model of the catalogue (see mote models), or a .toml file"}},
          {{"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", "Model", true},
           {"--columns", "M", "1", "doa: directions per frame, from 1 to 64", "Model"},
           {"--words", "", "", "search for the smallest fixed-point formats", "Words"},
           {"--budget", "X", "0.01", "by what part the error may exceed the double filter's", "Words"},
           {"--rounding", "HOW", "nearest", "nearest or truncate", "Words"},
           {"--margin", "X", "0.25", "by what part ranges are wider than what was seen", study},
           {"-n,--particles", "N", "200", "particles of the filter", study},
           {"--steps", "T", "50", "steps of a recording", study},
           {"--recordings", "R", "10", "recordings", study},
           {"--seed", "S", "1", "seed, an integer of at least 0; same seed, same result", study},
           {"--dot", "FILE", "", "the graph for Graphviz [none]", "Output"},
           {"--list", "FILE", "", "the graph as lines of text [none]", "Output"},
           {"--json", "FILE", "", "what was found, as JSON; - is standard output [none]", "Output"}},
          run_graph,
          ""};
}

}  // namespace mote
