#pragma once
/// `--set key=value`: settings as given, taken one by one, the leftovers refused.

#include <optional>
#include <string>
#include <vector>

#include "mote/model/parameter.hpp"

namespace mote {

/// The settings of one model on one command line.
class Settings {
 public:
  /// error   Refusal (kWrongUse) for text that is not key=value, or a key given twice
  Settings(std::string where, const std::vector<std::string>& texts);

  /// The text given for a key, if any; marks the key as known.
  std::optional<std::string> text(const std::string& key) const;
  /// The number given for a key, in its range, or the fallback.
  double number(const std::string& key, double fallback, Range range = Range::kAny) const;
  /// The integer given for a key, within [least, most], or the fallback.
  long integer(const std::string& key, long fallback, long least, long most) const;
  /// Refuses keys that nobody asked for; `known` lists those there are.
  void finish(const std::string& model, const std::vector<std::string>& known) const;

  const std::string& where() const { return where_; }

 private:
  struct Given {
    std::string key, value;
  };
  std::string where_;
  std::vector<Given> given_;
  mutable std::vector<bool> used_;
};

/// Words for a range, for messages and lists.
std::string words_for(Range range);

}  // namespace mote
