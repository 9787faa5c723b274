#include "mote/app/compare/contender.hpp"

#include <sstream>

#include <fmt/format.h>

#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote::compare {
namespace {

/// What opens the refusals of `mote run`, and what its readers of options are told.
constexpr std::string_view kRun = "mote run";

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words{"--filter"};
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// A sentence of `mote run` as one of the place that asked.
std::string said_at(const std::string& place, const std::string& sentence) {
  return sentence.starts_with(kRun) ? place + sentence.substr(kRun.size()) : place + ": " + sentence;
}

/// The arguments that words make; `place` is "mote compare: --filters: imh --improved".
template <class Use>
auto with_arguments(const std::vector<std::string>& words, const std::string& place, Use&& use) {
  try {
    return use(arguments_from(std::string(kRun), plan_options(), words));
  } catch (const Refusal& refusal) {
    throw Refusal(refusal.code(), said_at(place, refusal.what()));
  }
}

void refuse_own(const Arguments& arguments, const std::string& option) {
  if (arguments.given(option))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), option, "one for all, so that runs are paired",
                                        arguments.text(option), "Pass " + option + " to mote compare."});
}

Contender contender_from(const std::string& text, const std::vector<std::size_t>& particles, const std::string& where,
                         std::vector<std::string>& notes) {
  Contender contender{text, {}};
  const std::string place = where + ": --filters: " + text;
  for (const std::size_t n : particles)
    contender.plans.push_back(with_arguments(words_of(text), place, [&](const Arguments& given) {
      refuse_own(given, "--particles");
      refuse_own(given, "--seed");
      auto words = words_of(text);
      words.insert(words.end(), {"--particles", std::to_string(n)});
      Plan plan = plan_from(arguments_from(std::string(kRun), plan_options(), words));
      if (contender.plans.empty())
        for (const std::string& note : notes_on_unread(given, plan)) notes.push_back(said_at(place, note));
      return plan;
    }));
  return contender;
}

std::string name_among(const std::vector<Contender>& others, const std::string& text) {
  std::size_t same = 1;
  for (const Contender& other : others) same += other.name == text || other.name.starts_with(text + " (") ? 1 : 0;
  return same == 1 ? text : fmt::format("{} ({})", text, same);
}

}  // namespace

std::vector<Contender> contenders_from(const std::string& text, const std::vector<std::size_t>& particles,
                                       const std::string& where, std::vector<std::string>& notes) {
  std::vector<Contender> all;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ';');) {
    const std::string one(trimmed(part));
    if (one.empty()) continue;
    Contender contender = contender_from(one, particles, where, notes);
    contender.name = name_among(all, one);
    all.push_back(std::move(contender));
  }
  if (all.empty())
    throw Refusal(ExitCode::kWrongUse, {where, "--filters", "filters with their options, separated by ;", "none",
                                        "Pass --filters \"sisr; imh --improved\"."});
  return all;
}

Plan reference_plan(const std::string& text, const std::string& where, std::vector<std::string>& notes) {
  const std::string place = where + ": --reference: " + text;
  return with_arguments(words_of(text), place, [&](const Arguments& given) {
    refuse_own(given, "--seed");
    Plan plan = plan_from(given);
    for (const std::string& note : notes_on_unread(given, plan)) notes.push_back(said_at(place, note));
    return plan;
  });
}

}  // namespace mote::compare
