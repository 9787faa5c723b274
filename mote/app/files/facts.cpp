#include "mote/app/files/facts.hpp"

#include <algorithm>

#include <boost/crc.hpp>
#include <fmt/format.h>

#include "mote/app/catalogue/text_entry.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/numbers.hpp"

namespace mote {
namespace {

std::string shown(const std::pair<std::string, std::string>& fact) {
  return fact.first + " " + (fact.second.empty() ? "not given" : fact.second);
}

}  // namespace

std::string checksum_of(std::string_view text) {
  boost::crc_32_type checksum;
  checksum.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}", checksum.checksum());
}

std::string summed_up(const Recording& recording) {
  boost::crc_32_type checksum;
  const auto note = [&](const auto& number) { checksum.process_bytes(&number, sizeof number); };
  for (const ObservedStep& step : recording.steps) {
    note(step.t);
    note(step.rows.size());
    for (const Row<double>& row : step.rows)
      for (std::size_t j = 0; j < row.values.size(); ++j) note(row.present[j] ? row.values[j] : kNaN);
  }
  return fmt::format("{} steps, checksum {:08x}", recording.steps.size(), checksum.checksum());
}

RunFacts model_facts(const std::string& model, std::vector<std::string> settings) {
  RunFacts facts{{"mote", MOTE_VERSION}, {"MODEL", model}};
  if (is_text_model(model)) facts.emplace_back("model of checksum", checksum_of(read_text(model)));
  std::sort(settings.begin(), settings.end());
  facts.emplace_back("--set", fmt::format("{}", fmt::join(settings, " ")));
  for (const std::string& setting : settings)
    if (setting.starts_with("file="))
      facts.emplace_back("matrices of checksum", checksum_of(read_text(setting.substr(5))));
  return facts;
}

std::optional<std::pair<std::string, std::string>> difference(const RunFacts& ours, const RunFacts& theirs) {
  for (std::size_t k = 0; k < std::min(ours.size(), theirs.size()); ++k)
    if (ours[k] != theirs[k]) return std::pair(shown(ours[k]), shown(theirs[k]));
  if (ours.size() != theirs.size())
    return std::pair<std::string, std::string>("other options", "those of another mote");
  return std::nullopt;
}

}  // namespace mote
