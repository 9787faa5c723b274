#include "mote/app/reproduce/fields.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

/// A node as a message shows it: "nothing" for a key that is not there.
std::string shown(const toml::node* node) {
  if (node == nullptr) return "nothing";
  if (node->is_table()) return "a table";
  if (node->is_array()) return "a list";
  std::ostringstream text;
  node->visit([&](const auto& value) { text << value; });
  return text.str();
}

}  // namespace

toml::table parsed_toml(const std::string& path) {
  const std::string text = read_text(path);
  refuse_other_than_ascii(path, text);
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw Refusal(ExitCode::kBadData, {fmt::format("{}:{}", path, error.source().begin.line), "", "TOML",
                                       std::string(error.description()), ""});
  }
}

std::string Fields::where(const toml::node& node) const {
  return fmt::format("{}:{}", path_, std::max(1U, static_cast<unsigned>(node.source().begin.line)));
}

const toml::node* Fields::take(std::string_view key) {
  known_.emplace_back(key);
  return table_->get(key);
}

void Fields::refuse(std::string_view key, const std::string& expected) const {
  const toml::node* node = table_->get(key);
  throw Refusal(ExitCode::kBadData,
                {where(node == nullptr ? *table_ : *node), fmt::format("\"{}\"", key), expected, shown(node), ""});
}

std::string Fields::text(std::string_view key) {
  const toml::node* node = take(key);
  const auto* value = node == nullptr ? nullptr : node->as_string();
  if (value == nullptr || value->get().empty()) refuse(key, "a text");
  return value->get();
}

std::string Fields::text_or(std::string_view key, std::string_view fallback) {
  if (has(key)) return text(key);
  take(key);
  return std::string(fallback);
}

bool Fields::yes(std::string_view key) {
  const toml::node* node = take(key);
  if (node == nullptr) return false;
  if (!node->is_boolean()) refuse(key, "true or false");
  return node->as_boolean()->get();
}

std::int64_t Fields::integer(std::string_view key, std::int64_t least, std::int64_t most,
                             std::optional<std::int64_t> fallback) {
  const toml::node* node = take(key);
  if (node == nullptr && fallback) return *fallback;
  const auto* value = node == nullptr ? nullptr : node->as_integer();
  if (value == nullptr || value->get() < least || value->get() > most)
    refuse(key, fmt::format("an integer from {} to {}", least, most));
  return value->get();
}

bool Fields::is_number(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr && node->is_number();
}

std::optional<double> Fields::number(std::string_view key) {
  const toml::node* node = take(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value)) refuse(key, "a finite number");
  return value;
}

std::vector<std::string> Fields::texts(std::string_view key) {
  const toml::node* node = take(key);
  std::vector<std::string> out;
  if (node == nullptr) return out;
  if (!node->is_array()) refuse(key, "a list of texts");
  for (const auto& element : *node->as_array()) {
    if (!element.is_string()) refuse(key, "a list of texts");
    out.push_back(element.as_string()->get());
  }
  return out;
}

std::vector<double> Fields::numbers(std::string_view key) {
  const toml::node* node = take(key);
  std::vector<double> out;
  if (node == nullptr) return out;
  if (!node->is_array()) refuse(key, "a list of numbers");
  for (const auto& element : *node->as_array()) {
    const auto value = element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) refuse(key, "a list of finite numbers");
    out.push_back(*value);
  }
  return out;
}

std::vector<Fields> Fields::tables(std::string_view key) {
  const toml::node* node = take(key);
  std::vector<Fields> out;
  if (node == nullptr) return out;
  if (!node->is_array_of_tables()) refuse(key, fmt::format("tables [[{}]]", key));
  for (const auto& element : *node->as_array()) out.emplace_back(*element.as_table(), path_);
  return out;
}

Fields Fields::table(std::string_view key) {
  const toml::node* node = take(key);
  if (node == nullptr || !node->is_table()) refuse(key, fmt::format("a table [{}]", key));
  return {*node->as_table(), path_};
}

void Fields::finish() const {
  for (const auto& [key, value] : *table_)
    if (std::find(known_.begin(), known_.end(), key.str()) == known_.end())
      throw Refusal(ExitCode::kBadData, {where(value), fmt::format("\"{}\"", key.str()),
                                         fmt::format("one of {}", fmt::join(known_, ", ")), "", ""});
}

}  // namespace mote::reproduce
