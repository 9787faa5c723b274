#include "mote/app/reproduce/item.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

using Kind = Comparison::Kind;

struct KindWord {
  std::string_view word;
  Kind kind;
  std::size_t runs;
};
constexpr std::array<KindWord, 5> kKinds{{{"mean-difference", Kind::kMeanDifference, 2},
                                          {"rmse", Kind::kRmse, 1},
                                          {"rmse-ratio", Kind::kRmseRatio, 2},
                                          {"normalised-error", Kind::kNormalisedError, 1},
                                          {"evidence-spread", Kind::kEvidenceSpread, 1}}};

/// A TOML table whose keys are taken one by one; the leftovers are refused.
class Fields {
 public:
  Fields(const toml::table& table, std::string path) : table_(table), path_(std::move(path)) {}

  template <class T>
  std::optional<T> maybe(std::string_view key) {
    known_.emplace_back(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    auto value = node->value<T>();
    if (!value) refuse(*node, key, "another type");
    return value;
  }
  template <class T>
  T get(std::string_view key) {
    auto value = maybe<T>(key);
    if (!value) refuse(table_, key, "this key");
    return *value;
  }
  std::vector<std::string> texts(std::string_view key) {
    known_.emplace_back(key);
    std::vector<std::string> out;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return out;
    if (!node->is_array()) refuse(*node, key, "a list of texts");
    for (const auto& element : *node->as_array()) {
      auto text = element.value<std::string>();
      if (!text) refuse(element, key, "a list of texts");
      out.push_back(*text);
    }
    return out;
  }
  /// The tables of a list [[key]].
  std::vector<const toml::table*> tables(std::string_view key) {
    known_.emplace_back(key);
    std::vector<const toml::table*> out;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return out;
    if (!node->is_array_of_tables()) refuse(*node, key, fmt::format("tables [[{}]]", key));
    for (const auto& element : *node->as_array()) out.push_back(element.as_table());
    return out;
  }
  const toml::table& table(std::string_view key) {
    known_.emplace_back(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr || !node->is_table()) refuse(table_, key, fmt::format("a table [{}]", key));
    return *node->as_table();
  }
  const toml::node* node(std::string_view key) {
    known_.emplace_back(key);
    return table_.get(key);
  }
  void finish() const {
    for (const auto& [key, value] : table_)
      if (std::find(known_.begin(), known_.end(), key.str()) == known_.end())
        throw Refusal(ExitCode::kBadData, {where(value), fmt::format("\"{}\"", key.str()),
                                           fmt::format("one of {}", fmt::join(known_, ", ")), "", ""});
  }
  [[noreturn]] void refuse(const toml::node& node, std::string_view key, const std::string& expected) const {
    throw Refusal(ExitCode::kBadData, {where(node), fmt::format("\"{}\"", key), expected, "", ""});
  }

 private:
  std::string where(const toml::node& node) const { return fmt::format("{}:{}", path_, node.source().begin.line); }

  const toml::table& table_;
  std::string path_;
  std::vector<std::string> known_;
};

Simulated simulated_from(Fields fields) {
  Simulated s;
  s.model = fields.get<std::string>("model");
  s.steps = static_cast<int>(fields.get<std::int64_t>("steps"));
  s.seed = static_cast<std::uint64_t>(fields.maybe<std::int64_t>("seed").value_or(1));
  s.columns = static_cast<int>(fields.maybe<std::int64_t>("columns").value_or(1));
  s.settings = fields.texts("set");
  fields.finish();
  return s;
}

Run run_from(Fields fields) {
  Run run{fields.get<std::string>("name"), fields.texts("options"), fields.texts("set")};
  fields.finish();
  return run;
}

Figure figure_from(Fields fields) {
  Figure figure;
  figure.title = fields.get<std::string>("title");
  figure.state = fields.maybe<std::string>("state").value_or("");
  figure.error = fields.maybe<bool>("error").value_or(false);
  fields.finish();
  return figure;
}

Comparison comparison_from(Fields fields, const std::vector<Run>& runs) {
  Comparison c;
  c.name = fields.get<std::string>("name");
  const auto word = fields.get<std::string>("kind");
  const auto* found = std::find_if(kKinds.begin(), kKinds.end(), [&](const KindWord& k) { return k.word == word; });
  if (found == kKinds.end())
    fields.refuse(*fields.node("kind"), "kind",
                  "mean-difference, rmse, rmse-ratio, normalised-error or evidence-spread");
  c.kind = found->kind;
  c.runs = fields.texts("runs");
  if (c.runs.size() != found->runs)
    fields.refuse(*fields.node("kind"), "runs", fmt::format("{} run names for {}", found->runs, word));
  for (const std::string& name : c.runs)
    if (std::none_of(runs.begin(), runs.end(), [&](const Run& r) { return r.name == name; }))
      fields.refuse(*fields.node("runs"), "runs", "names of the item's runs");
  c.state = fields.maybe<std::string>("state").value_or("");
  c.repeats = static_cast<int>(fields.maybe<std::int64_t>("repeats").value_or(20));
  c.at_least = fields.maybe<double>("at_least");
  c.at_most = fields.maybe<double>("at_most");
  if (const toml::node* paper = fields.node("paper")) {
    if (const auto number = paper->value_exact<double>()) {
      c.paper = *number;
    } else {
      c.paper = paper->value_or<std::string>("");
    }
  }
  c.note = fields.maybe<std::string>("note").value_or("");
  fields.finish();
  return c;
}

toml::table parsed(const std::string& path) {
  const std::string text = read_text(path);
  refuse_other_than_ascii(path, text);
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw Refusal(ExitCode::kBadData, {fmt::format("{}:{}", path, error.source().begin.line), "", "TOML",
                                       std::string(error.description()), ""});
  }
}

}  // namespace

std::string word_for(Kind kind) {
  const auto* found = std::find_if(kKinds.begin(), kKinds.end(), [&](const KindWord& k) { return k.kind == kind; });
  return std::string(found->word);
}

Item read_item(const std::string& path, const std::string& paper) {
  const toml::table root = parsed(path);
  Fields fields(root, path);
  Item item;
  item.file = path;
  item.paper = paper;
  item.name = fields.get<std::string>("item");
  item.title = fields.get<std::string>("title");
  item.printed = fields.get<std::string>("printed");
  item.note = fields.maybe<std::string>("note").value_or("");
  item.simulated = simulated_from(Fields(fields.table("simulate"), path));
  for (const toml::table* table : fields.tables("run")) item.runs.push_back(run_from(Fields(*table, path)));
  for (const toml::table* table : fields.tables("figure")) item.figures.push_back(figure_from(Fields(*table, path)));
  for (const toml::table* table : fields.tables("compare"))
    item.comparisons.push_back(comparison_from(Fields(*table, path), item.runs));
  fields.finish();
  return item;
}

}  // namespace mote::reproduce
