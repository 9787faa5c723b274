#pragma once
/// A TOML table whose keys are taken one by one; a key that nobody asked for is refused.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace mote::reproduce {

/// A TOML file, whole.
///
/// error   Refusal (kBadData) naming file:line for what is no TOML, or goes beyond ASCII
toml::table parsed_toml(const std::string& path);

/// The fields of one table. Every refusal is kBadData, names file:line and the key, and lists what was expected.
class Fields {
 public:
  Fields(const toml::table& table, std::string path) : table_(&table), path_(std::move(path)) {}

  /// "file:line" of the table.
  std::string where() const { return where(*table_); }
  bool has(std::string_view key) const { return table_->get(key) != nullptr; }

  /// A text that must be there and say something.
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string_view fallback);
  bool yes(std::string_view key);
  std::int64_t integer(std::string_view key, std::int64_t least, std::int64_t most,
                       std::optional<std::int64_t> fallback = std::nullopt);
  /// A finite number, if the key is there.
  std::optional<double> number(std::string_view key);
  /// Whether a key that may be a number or a text holds a number.
  bool is_number(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key);
  /// A list of finite numbers; none without the key.
  std::vector<double> numbers(std::string_view key);
  /// The place of a word among the choices, the first by default.
  template <class Choices>
  std::size_t choice(std::string_view key, const Choices& choices) {
    const std::string word = text_or(key, choices.front());
    std::string known;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (choices[i] == word) return i;
      known += (i == 0 ? "" : ", ") + std::string(choices[i]);
    }
    refuse(key, "one of " + known);
  }
  /// The tables of a list [[key]]; none without the key.
  std::vector<Fields> tables(std::string_view key);
  /// The table [key].
  Fields table(std::string_view key);
  /// Refuses keys that nobody asked for.
  void finish() const;

  [[noreturn]] void refuse(std::string_view key, const std::string& expected) const;

 private:
  std::string where(const toml::node& node) const;
  const toml::node* take(std::string_view key);

  const toml::table* table_;
  std::string path_;
  std::vector<std::string> known_;
};

}  // namespace mote::reproduce
