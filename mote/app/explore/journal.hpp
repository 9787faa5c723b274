#pragma once
/// The journal of an exploration: what was found, kept in a file as it is found, so that the same command goes on.

#include <condition_variable>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/explore/target.hpp"
#include "mote/app/files/facts.hpp"

namespace mote::explore {

/// Mean squared errors of a run; infinite after a collapse, NaN to what is not known.
struct Errors {
  double reference = 0, truth = 0;
};

/// A file of JSON lines: first the facts that the findings belong to, then a finding each. Lines are added as findings
/// are made; one that was cut short, by whatever ended the program, is found again. Without a path it is kept in memory
/// alone.
///
/// error   Refusal (kWrongUse) when the file belongs to another exploration; (kBadData) naming the line that is none of
///         its own, and the file stays as it is; (kCannotWrite)
class Journal final : public Memory {
 public:
  Journal(std::string path, const RunFacts& facts);
  ~Journal() override;
  Journal(const Journal&) = delete;
  Journal(Journal&&) = delete;
  Journal& operator=(const Journal&) = delete;
  Journal& operator=(Journal&&) = delete;

  std::vector<double> recall(const std::string& name, std::size_t values,
                             const std::function<std::vector<double>()>& find) override;
  /// The errors of a candidate's run, where they are known.
  std::optional<Errors> errors(std::size_t candidate, std::size_t run) const;
  void keep(std::size_t candidate, std::size_t run, const Errors& errors);

 private:
  /// Values, and the line of the file that they were read from; 0: none.
  struct Found {
    std::vector<double> values;
    std::size_t line = 0;
  };

  /// Whether there is anything in the file, once what was cut short is gone.
  bool read(const RunFacts& facts);
  void take(std::string_view text, std::size_t number);
  void check_facts(const nlohmann::json& kept, const RunFacts& facts) const;
  [[noreturn]] void refuse_line(std::size_t line, const std::string& expected, const std::string& got) const;
  void append(const nlohmann::json& line);

  std::string path_;
  std::FILE* file_ = nullptr;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::set<std::string> sought_;  ///< names that a thread is finding values for
  std::map<std::string, Found> found_;
  std::map<std::pair<std::size_t, std::size_t>, Errors> errors_;
};

}  // namespace mote::explore
