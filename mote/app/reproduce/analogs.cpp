#include "mote/app/reproduce/analogs.hpp"

#include "mote/analog/spice.hpp"
#include "mote/app/analog/characterisation.hpp"
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
  if (source.command == "characterise") {
    const CharacteriseRequest request =
        characterise_request_from(arguments_from(run.where, characterise_options(), words));
    return {source.command + joined(words), [request] {
              const Characterisation found = characterisation(request, [](std::size_t, std::size_t) {});
              return Answer{characterisation_json(found), characterisation_page(found)};
            }};
  }
  throw Refusal(ExitCode::kBadData, {source.where, "\"command\"", "characterise", "\"" + source.command + "\"", ""});
}

Analogs::Analogs(const Item& item) : first_(item.runs.front().name) {
  for (const Run& run : item.runs) questions_.emplace(run.name, question(*item.analog, run));
}

std::string Analogs::missing() const {
  try {
    analog::Spice::loaded();
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
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
  return answer_at(answer(c.runs[side], ran).figures, c, "mote analog characterise", "arctan/0/rms_percent");
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
