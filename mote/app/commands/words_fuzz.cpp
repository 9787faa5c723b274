// Fuzzes the small languages of the command line: options, settings and estimates end in a value or a refusal.

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/compare/contender.hpp"
#include "mote/app/terminal/suggestion.hpp"
#include "mote/base/refusal.hpp"
#include "mote/engine/estimand.hpp"
#include "mote/model/bearings.hpp"

namespace {

template <class Read>
void attempt(Read&& read) {
  try {
    read();
  } catch (const mote::Refusal&) {  // what bad words are meant to give
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::stringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  static const auto sources = mote::value_sources(mote::Bearings{});
  static const auto options = mote::plan_options();
  attempt([&] { mote::parse_estimand(text, sources, "fuzz"); });
  attempt([&] {
    const mote::Settings settings("fuzz", {text});
    settings.number("q", 1, mote::Range::kPositive);
    settings.integer("copies", 1, 1, 2);
    settings.finish("fuzz", {"q", "copies"});
  });
  const std::vector<std::string> words = lines_of(text);
  attempt([&] {
    for (const mote::CatalogueEntry& entry : mote::catalogue()) {
      if (entry.name == "linear-gaussian") continue;  // would read the file that a setting names
      entry.make(mote::Settings("fuzz", words), std::vector<std::string>{"t", "doa1"});
    }
  });
  attempt([&] { mote::plan_from(mote::arguments_from("fuzz", options, words)); });
  attempt([&] {
    std::vector<std::string> notes;
    mote::compare::contenders_from(text, {10}, "fuzz", notes);
  });
  mote::nearest(text, {"sisr", "imh", "auxiliary"});
  return 0;
}
