#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/command.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/reproduce/publication.hpp"
#include "mote/app/terminal/progress.hpp"

namespace mote {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kPapers{"imh-hw", "fpga", "mixed", "imh-opt", "ppf"};

/// The folder of the papers: beside the build tree's folder, or installed beside the program.
fs::path papers_folder(const std::string& where) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {program / "../papers", program / "../share/mote/papers"})
    if (fs::is_directory(folder, error)) return fs::weakly_canonical(folder);
  throw Refusal(
      ExitCode::kBadData,
      {where, "papers", "a folder papers beside the program's folder, or share/mote/papers where it is installed",
       "neither at " + program.string(), "Install mote, or run build/mote of a checkout."});
}

std::vector<fs::path> items_of(const fs::path& folder) {
  std::vector<fs::path> items;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") items.push_back(entry.path());
  std::sort(items.begin(), items.end());
  return items;
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path))
    throw Refusal(ExitCode::kCannotWrite, {path, "", "a folder that can be made",
                                           error ? error.message() : "a file of that name", "Pass another --out."});
}

std::vector<reproduce::Regenerated> regenerate_all(const std::vector<std::string>& papers, const fs::path& folder) {
  std::vector<std::pair<std::string, fs::path>> files;
  for (const std::string& paper : papers) {
    const auto items = items_of(folder / paper);
    if (items.empty()) fmt::print("{}: no items yet\n", paper);
    for (const fs::path& item : items) files.emplace_back(paper, item);
  }
  std::vector<reproduce::Regenerated> all;
  Progress progress("items");
  for (const auto& [paper, file] : files) {
    reproduce::Item item = reproduce::read_item(file.string(), paper);
    reproduce::Outcome outcome = reproduce::regenerate(item);
    all.push_back({std::move(item), std::move(outcome)});
    progress.update(all.size(), files.size());
  }
  return all;
}

void print_results(const std::vector<reproduce::Regenerated>& all) {
  for (const auto& [item, outcome] : all)
    for (const auto& result : outcome.results)
      fmt::print("{:<5} {} {}: {}: {:.4g}\n", result.holds ? "holds" : "NOT", item.paper, item.name, result.asked.name,
                 result.ours);
}

ExitCode run_reproduce(const Arguments& arguments) {
  std::vector<std::string> choices = kPapers;
  choices.emplace_back("all");
  const std::size_t choice = arguments.choice("PAPER", choices);
  const std::vector<std::string> papers =
      choice == kPapers.size() ? kPapers : std::vector<std::string>{kPapers[choice]};
  const std::string out =
      arguments.required("--out", "a folder for figures, page and comparison.json", "Pass --out reproduced.");
  const fs::path folder = papers_folder(arguments.where());
  make_folder(out);
  const auto all = regenerate_all(papers, folder);
  OutputSet outputs;
  outputs.open(out + "/comparison.json")->write(reproduce::comparison_json(all).dump(2) + "\n");
  outputs.open(out + "/index.html")
      ->write(report::html(reproduce::page_of(choices[choice], all, arguments.command_line())));
  for (const auto& [item, outcome] : all)
    outputs.open(out + "/" + reproduce::slug(item) + ".csv")->write(reproduce::figure_csv(outcome));
  outputs.commit();
  print_results(all);
  fmt::print("{}/index.html, {}/comparison.json\n", out, out);
  return ExitCode::kDone;
}

}  // namespace

Command reproduce_command() {
  return {"reproduce",
          "Regenerate the papers' figures and tables",
          {{"PAPER", "imh-hw, fpga, mixed, imh-opt, ppf or all"}},
          {{"--out", "DIR", "", "folder for figures (CSV), index.html and comparison.json", "Output"}},
          run_reproduce,
          "Items are data: papers/<name>/*.toml. An item that does not hold is a result, not an error."};
}

}  // namespace mote
