#include "mote/app/reproduce/script.hpp"

#include <fmt/format.h>

#include "mote/app/terminal/shell.hpp"

namespace mote::reproduce {
namespace {

std::string set_options(const std::vector<std::string>& settings) {
  std::string words;
  for (const std::string& setting : settings) words += " --set " + shell_word(setting);
  return words;
}

/// A word behind the folder that MOTE_DATA names.
std::string in_data(const std::string& file) { return "\"$MOTE_DATA\"/" + shell_word(file); }

std::string tracks_for(const Item& item) {
  const Clip& clip = *item.clip;
  std::string script;
  for (const Run& run : item.runs) {
    script += fmt::format("mote track {} --init {} --truth {} --frames {}", in_data(clip.video), clip.init,
                          in_data(clip.truth), clip.frames);
    for (const auto& options : {clip.options, run.options})
      for (const std::string& option : options) script += " " + shell_word(option);
    if (run.number > 0) script += fmt::format(" --particles {}", run.number);
    script += fmt::format(" --summary {}-{}.json\n", slug(item.paper + "-" + item.name), slug(run.name));
  }
  return script;
}

/// A command for each run of an item that has nothing but options.
std::string commands_for(const Item& item, const std::string& command, const std::vector<std::string>& common) {
  std::string script;
  for (const Run& run : item.runs) {
    script += command;
    for (const auto& options : {common, run.options})
      for (const std::string& option : options) script += " " + shell_word(option);
    script += fmt::format(" --json {}-{}.json\n", slug(item.paper + "-" + item.name), slug(run.name));
  }
  return script;
}

}  // namespace

std::string script_for(const Item& item) {
  if (item.weights) return "";
  if (item.cluster) return commands_for(item, "mote simulate-cluster --stage-parallel", *item.cluster);
  if (item.design) return commands_for(item, "mote design optimise", *item.design);
  if (item.analog) return commands_for(item, "mote analog " + item.analog->command, item.analog->options);
  if (item.clip) return item.clip->drawn() ? "" : tracks_for(item);
  const Source& from = item.recording;
  const std::string base = slug(item.paper + "-" + item.name);
  std::string data = from.observations;
  std::string truth = from.truth;
  std::string script;
  if (from.simulated()) {
    data = base + "-data.csv";
    truth = base + "-truth.csv";
    script = fmt::format("mote simulate {} --steps {} --seed {}{}{} --out {} --truth {}\n", from.model, from.steps,
                         from.seed, from.columns > 1 ? fmt::format(" --columns {}", from.columns) : "",
                         set_options(from.settings), data, truth);
  }
  for (const Run& run : item.runs) {
    script += fmt::format("mote {} {} {} {}{}{}",
                          run.circuit  ? "rtl"
                          : run.analog ? "analog run"
                                       : "run",
                          from.model, run.circuit ? "--simulate" : "--data", shell_word(data),
                          truth.empty() ? "" : " --truth " + shell_word(truth),
                          set_options(merged(from.settings, run.settings)));
    for (const std::string& option : run.options) script += " " + shell_word(option);
    script += fmt::format(" --out {}-{}{}\n", base, slug(run.name), run.circuit ? "" : ".csv");
  }
  return script;
}

}  // namespace mote::reproduce
