#include "mote/app/reproduce/analogs.hpp"

#include "mote/analog/spice.hpp"
#include "mote/app/analog/characterisation.hpp"
#include "mote/app/analog/power_report.hpp"
#include "mote/app/reproduce/answers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += '\n' + word;
  return line;
}

}  // namespace

Analogs::Question Analogs::question(const AnalogSource& source, const Run& run) {
  std::vector<std::string> words = source.options;
  words.insert(words.end(), run.options.begin(), run.options.end());
  const std::string asked = source.command + joined(words);
  if (source.command == "characterise") {
    const CharacteriseRequest request =
        characterise_request_from(arguments_from(run.where, characterise_options(), words));
    return {asked, true, [request] {
              const Characterisation found = characterisation(request, [](std::size_t, std::size_t) {});
              return Answer{characterisation_json(found), characterisation_page(found)};
            }};
  }
  if (source.command == "power") {
    const Arguments arguments = arguments_from(run.where, power_options(), words);
    const bool simulates = arguments.given("--simulated");
    if (!simulates) (void)power_request_from(arguments);  // so that wrong options show before the work
    return {asked, simulates, [arguments] {
              const PowerRequest request = power_request_from(arguments);
              return Answer{power_json(request), power_page(request, "")};
            }};
  }
  throw Refusal(ExitCode::kBadData,
                {source.where, "\"command\"", "characterise or power", "\"" + source.command + "\"", ""});
}

Analogs::Analogs(const Item& item) : first_(item.runs.front().name) {
  for (const Run& run : item.runs) questions_.emplace(run.name, question(*item.analog, run));
}

std::string Analogs::missing() const {
  const auto simulates = [](const auto& entry) { return entry.second.simulates; };
  return std::any_of(questions_.begin(), questions_.end(), simulates) ? analog::Spice::missing() : "";
}

const Analogs::Answer& Analogs::answer(const std::string& run, const std::function<void()>& ran) {
  static std::map<std::string, Answer> answers;
  const Question& question = questions_.at(run);
  const auto known = answers.find(question.words);
  if (known != answers.end()) return known->second;
  const Answer& fresh = answers.emplace(question.words, question.ask()).first->second;
  ran();
  return fresh;
}

double Analogs::figure(const Comparison& c, std::size_t side, const std::function<void()>& ran) {
  return answer_at(answer(c.runs[side], ran).figures, c, "the item's command",
                   "arctan/0/rms_percent (characterise) or table5/method1/printed/uw (power)");
}

report::Chart Analogs::chart(const Figure& figure, const std::function<void()>& ran) {
  std::string titles;
  for (const report::Chart& chart : answer(figure.runs.empty() ? first_ : figure.runs.front(), ran).page.charts) {
    if (chart.title == figure.quantity) return chart;
    titles += (titles.empty() ? "" : ", ") + chart.title;
  }
  throw Refusal(ExitCode::kBadData,
                {figure.where, "\"quantity\"", "one of the charts " + titles, "\"" + figure.quantity + "\"", ""});
}

}  // namespace mote::reproduce
