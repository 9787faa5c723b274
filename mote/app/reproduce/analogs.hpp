#pragma once
/// Analog circuits: what a command of `mote analog` answers to the runs of an item.

#include <functional>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "mote/app/reproduce/item.hpp"
#include "mote/report/page.hpp"

namespace mote::reproduce {

/// The runs of one item. There is no chance in them: their repeats are all the same, and what one item has asked is not
/// simulated again for another.
class Analogs {
 public:
  /// error   Refusal (kBadData, kWrongUse) naming file:line for a command that there is not, or options that it does
  /// not
  ///         have
  explicit Analogs(const Item& item);

  /// Why nothing can be computed, in a sentence: ngspice is missing; else empty.
  std::string missing() const;
  std::size_t work() const { return questions_.size(); }
  /// What a comparison asks of one of its runs: a number of its JSON, yes as 1 and no as 0.
  ///
  /// error   Refusal (kBadData) for a path that does not lead to one
  double figure(const Comparison& comparison, std::size_t side, const std::function<void()>& ran);
  /// The chart of a figure's run, of the first where it names none.
  ///
  /// error   Refusal (kBadData) for a title that no chart has
  report::Chart chart(const Figure& figure, const std::function<void()>& ran);

 private:
  struct Answer {
    nlohmann::json figures;
    report::Page page;
  };
  struct Question {
    std::string words;  ///< the same words have the same answer
    bool simulates;     ///< asks ngspice
    std::function<Answer()> ask;
  };

  static Question question(const AnalogSource& source, const Run& run);
  const Answer& answer(const std::string& run, const std::function<void()>& ran);

  std::string first_;
  std::map<std::string, Question> questions_;  // by run
};

}  // namespace mote::reproduce
