#pragma once
/// The journal of an exploration: what was found, kept in a file as it is found, so that the same command goes on.

#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "mote/app/explore/target.hpp"

namespace mote::explore {

/// Mean squared errors of a run; infinite after a collapse, NaN to what is not known.
struct Errors {
  double reference = 0, truth = 0;
};

/// A file of JSON lines: first what the findings belong to, then a finding each. Lines are added as findings are made;
/// one that was cut short, by whatever ended the program, is found again. Without a path it is kept in memory alone.
///
/// error   Refusal (kWrongUse) when the file belongs to another exploration; (kBadData) when it is none;
///         (kCannotWrite)
class Journal final : public Memory {
 public:
  Journal(std::string path, const nlohmann::json& belongs);
  ~Journal() override;
  Journal(const Journal&) = delete;
  Journal(Journal&&) = delete;
  Journal& operator=(const Journal&) = delete;
  Journal& operator=(Journal&&) = delete;

  std::vector<double> recall(const std::string& name, const std::function<std::vector<double>()>& find) override;
  /// The errors of a candidate's run, where they are known.
  std::optional<Errors> errors(std::size_t candidate, std::size_t run) const;
  void keep(std::size_t candidate, std::size_t run, const Errors& errors);

 private:
  /// Whether there is anything in the file, once what was cut short is gone.
  bool read(const nlohmann::json& belongs);
  void take(const nlohmann::json& line);
  void append(const nlohmann::json& line);

  std::string path_;
  std::FILE* file_ = nullptr;
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<double>> found_;
  std::map<std::pair<std::size_t, std::size_t>, Errors> errors_;
};

}  // namespace mote::explore
