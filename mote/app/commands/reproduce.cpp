#include <algorithm>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/command.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/files/text.hpp"
#include "mote/app/reproduce/faults.hpp"
#include "mote/app/reproduce/figures.hpp"
#include "mote/app/reproduce/publication.hpp"
#include "mote/app/terminal/progress.hpp"
#include "mote/base/parallel.hpp"
#include "mote/software/threads.hpp"

namespace mote {
namespace {

namespace fs = std::filesystem;
using namespace reproduce;

const std::vector<std::string> kPapers{"imh-hw", "fpga", "mixed", "imh-opt", "ppf"};

/// The folder of the papers: beside the build tree's folder (build/, or build/asan/ of a preset), or installed beside
/// the program's.
fs::path papers_folder(const std::string& where) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path beside = (program / "../papers").lexically_normal();
  const fs::path installed = (program / "../share/mote/papers").lexically_normal();
  const fs::path beside_preset = (program / "../../papers").lexically_normal();
  for (const fs::path& folder : {beside, installed, beside_preset})
    if (fs::is_directory(folder, error)) return folder;
  throw Refusal(ExitCode::kBadData,
                {where, "", fmt::format("the papers' items in {} or {}", beside.string(), installed.string()),
                 "neither folder", "Install mote, or run build/mote of a checkout."});
}

std::vector<fs::path> items_of(const fs::path& folder) {
  std::vector<fs::path> items;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") items.push_back(entry.path());
  std::sort(items.begin(), items.end(), [](const fs::path& a, const fs::path& b) { return a.stem() < b.stem(); });
  return items;
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path))
    throw Refusal(ExitCode::kCannotWrite, {path, "", "a folder that can be made",
                                           error ? error.message() : "a file of that name", "Pass another --out."});
}

std::string file_name(const Item& item) { return slug(item.paper + "-" + item.name); }

/// Every item of the papers, read and checked before the first one runs.
std::vector<Laboratory> laboratories_for(const std::vector<std::string>& papers, const fs::path& folder,
                                         std::optional<int> repeats) {
  std::vector<Laboratory> all;
  for (const std::string& paper : papers)
    for (const fs::path& file : items_of(folder / paper)) {
      Item item = read_item(file.string(), paper);
      for (Comparison& comparison : item.comparisons)
        if (has_chance(comparison)) comparison.repeats = repeats.value_or(comparison.repeats);
      for (Figure& figure : item.figures) figure.repeats = repeats.value_or(figure.repeats);
      for (const Laboratory& other : all)
        if (file_name(other.item()) == file_name(item))
          throw Refusal(ExitCode::kBadData, {item.file, "\"item\"", "a name that no other item has",
                                             "\"" + item.name + "\", as in " + other.item().file, ""});
      all.emplace_back(std::move(item));
    }
  return all;
}

/// Takes out the items whose clip, or whose simulator, is not there; returns what is to be said of them.
std::vector<std::string> take_out_missing(std::vector<Laboratory>& laboratories) {
  std::vector<std::string> said;
  for (const Laboratory& laboratory : laboratories)
    if (const std::string missing = laboratory.missing(); !missing.empty())
      said.push_back(fmt::format("skipped {} {}: {}", laboratory.item().paper, laboratory.item().name, missing));
  std::erase_if(laboratories, [](const Laboratory& laboratory) { return !laboratory.missing().empty(); });
  return said;
}

/// Regenerates item by item, after what outside tools find for all of them, side by side on all processors.
std::vector<Regenerated> regenerate_all(std::vector<Laboratory>& laboratories) {
  std::vector<std::function<void()>> errands;
  std::size_t work = 0;
  std::size_t done = 0;
  for (Laboratory& laboratory : laboratories) {
    for (auto& errand : laboratory.errands()) errands.push_back(std::move(errand));
    work += laboratory.work();
  }
  work += errands.size();
  Progress progress("runs");
  std::mutex mutex;
  const auto ran = [&] {
    const std::lock_guard lock(mutex);
    progress.update(++done, work);
  };
  in_parallel(errands.size(), cores(), [&](std::size_t k) {
    refuse_when_stopped();
    errands[k]();
    ran();
  });
  std::vector<Regenerated> all;
  for (Laboratory& laboratory : laboratories) {
    Outcome outcome = laboratory.regenerate(ran);
    all.push_back({laboratory.item(), std::move(outcome)});
  }
  return all;
}

void write_all(const std::string& out, const std::vector<Regenerated>& all, const report::Page& page) {
  OutputSet outputs;
  outputs.open(out + "/comparison.json")->write(comparison_json(all).dump(2) + "\n");
  outputs.open(out + "/index.html")->write(report::html(page));
  for (const auto& [item, outcome] : all)
    outputs.open(out + "/" + file_name(item) + ".csv")->write(figure_csv(outcome));
  outputs.commit();
}

ExitCode run_reproduce(const Arguments& arguments) {
  std::vector<std::string> choices = kPapers;
  choices.emplace_back("all");
  const std::size_t choice = arguments.choice("PAPER", choices);
  const std::vector<std::string> papers =
      choice == kPapers.size() ? kPapers : std::vector<std::string>{kPapers[choice]};
  const std::string out =
      arguments.required("--out", "a folder for figures, page and comparison.json", "Pass --out reproduced.");
  std::optional<int> repeats;
  if (arguments.given("--repeats")) repeats = static_cast<int>(arguments.integer("--repeats", 2, 10'000));
  auto laboratories = laboratories_for(papers, papers_folder(arguments.where()), repeats);
  make_folder(out);
  for (const std::string& paper : papers)
    if (std::none_of(laboratories.begin(), laboratories.end(),
                     [&](const Laboratory& l) { return l.item().paper == paper; }))
      fmt::print("{}: no items yet\n", paper);
  const std::vector<std::string> skipped = take_out_missing(laboratories);
  for (const std::string& sentence : skipped) fmt::print("{}\n", printable(sentence));
  const auto all = regenerate_all(laboratories);
  report::Page page = page_of(choices[choice], all, arguments.command_line());
  page.notes.insert(page.notes.end(), skipped.begin(), skipped.end());
  write_all(out, all, page);
  fmt::print("{}{}/index.html, {}/comparison.json\n", comparison_text(all), out, out);
  return ExitCode::kDone;
}

}  // namespace

Command reproduce_command() {
  return {"reproduce",
          "Regenerate the papers' figures and tables",
          {{"PAPER", "imh-hw, fpga, mixed, imh-opt, ppf or all"}},
          {{"--out", "DIR", "", "folder for figures (CSV), index.html and comparison.json", "Output"},
           {"--repeats", "R", "",
            "repeats of every comparison by chance and of every figure, from 2 to 10000 [each item's own]", "Output"}},
          run_reproduce,
          "Items are data: papers/<name>/*.toml (papers/README.md says how). One that does not hold is a result, not "
          "an error."};
}

}  // namespace mote
