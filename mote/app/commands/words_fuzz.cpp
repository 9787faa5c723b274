// Fuzzes the small languages of the command line: settings and estimates end in a value or a refusal.

#include <cstddef>
#include <cstdint>
#include <string>

#include "mote/app/catalogue/settings.hpp"
#include "mote/base/refusal.hpp"
#include "mote/engine/estimand.hpp"
#include "mote/model/bearings.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  static const auto kSources = mote::value_sources(mote::Bearings{});
  try {
    mote::parse_estimand(text, kSources, "fuzz");
  } catch (const mote::Refusal&) {  // what bad words are meant to give
  }
  try {
    const mote::Settings settings("fuzz", {text});
    settings.number("q", 1, mote::Range::kPositive);
    settings.finish("fuzz", "q");
  } catch (const mote::Refusal&) {  // likewise
  }
  return 0;
}
