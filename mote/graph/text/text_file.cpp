#include "mote/graph/text/text_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <toml++/toml.h>

#include "mote/base/refusal.hpp"

namespace mote::graph {
namespace {

const std::string kSections = "A model has name, [parameters], [inputs], [states], [noise], [next] and [observations].";

std::string line_of(const std::string& path, const toml::node& node) {
  return path + ":" + std::to_string(node.source().begin.line);
}

/// What a value is, in words.
std::string shown(const toml::node& node) {
  if (const auto text = node.value<std::string>()) return "\"" + *text + "\"";
  if (const auto number = node.value<double>(); number && node.is_number()) return std::to_string(*number);
  return node.is_table() ? "a table" : node.is_array() ? "an array" : "another kind of value";
}

/// The entries of a table in the order of the file.
std::vector<std::pair<std::string, const toml::node*>> in_order(const toml::table& table) {
  std::vector<std::pair<std::string, const toml::node*>> all;
  for (const auto& [key, value] : table) all.emplace_back(std::string(key.str()), &value);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    const auto& u = a.second->source().begin;
    const auto& v = b.second->source().begin;
    return u.line != v.line ? u.line < v.line : u.column < v.column;
  });
  return all;
}

class Reader {
 public:
  Reader(std::string path, const toml::table& root) : root_(root) { file_.path = std::move(path); }

  TextFile read() {
    refuse_other_keys();
    file_.name = word("name", std::filesystem::path(file_.path).stem().string());
    file_.meaning = word("meaning", "a model given as text");
    file_.parameters = numbers("parameters");
    file_.inputs = numbers("inputs");
    file_.states = expressions("states", true);
    file_.noise = expressions("noise", false);
    read_next();
    read_observations();
    return std::move(file_);
  }

 private:
  [[noreturn]] void refuse(const toml::node& at, const std::string& what, const std::string& expected,
                           const std::string& got, const std::string& next) const {
    throw Refusal(ExitCode::kBadData, {line_of(file_.path, at), what, expected, got, next});
  }
  [[noreturn]] void refuse_absence(const std::string& what, const std::string& expected,
                                   const std::string& next) const {
    throw Refusal(ExitCode::kBadData, {file_.path, what, expected, "nothing", next});
  }

  void refuse_other_keys() const {
    for (const auto& [key, node] : in_order(root_))
      if (key != "name" && key != "meaning" && key != "parameters" && key != "inputs" && key != "states" &&
          key != "noise" && key != "next" && key != "observations")
        refuse(*node, "", "a section or key of a model", "\"" + key + "\"", kSections);
  }

  std::string word(const std::string& key, const std::string& fallback) const {
    const toml::node* node = root_.get(key);
    if (node == nullptr) return fallback;
    if (const auto text = node->value<std::string>(); text && node->is_string() && !text->empty()) return *text;
    refuse(*node, key, "a text", shown(*node), "Write " + key + " = \"growth\".");
  }

  const toml::table* section(const std::string& key) const {
    const toml::node* node = root_.get(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) refuse(*node, key, "a section", shown(*node), "Write [" + key + "] on a line of its own.");
    return node->as_table();
  }

  /// A new name, which may stand for one thing only.
  void claim(const toml::node& at, const std::string& name, const std::string& role) {
    if (!is_free_name(name))
      refuse(at, "\"" + name + "\"", "a name of letters, digits and _ that is no function, pi, e or t",
             "\"" + name + "\"", "Choose another name.");
    const auto [place, fresh] = names_.try_emplace(name, role);
    if (!fresh)
      refuse(at, "\"" + name + "\"", "a name for one thing only", "a " + role + " that is also a " + place->second,
             "Choose another name.");
  }

  std::vector<NamedNumber> numbers(const std::string& key) {
    std::vector<NamedNumber> all;
    const toml::table* table = section(key);
    if (table == nullptr) return all;
    for (const auto& [name, node] : in_order(*table)) {
      claim(*node, name, key == "inputs" ? "input" : "parameter");
      const auto value = node->value<double>();
      if (!node->is_number() || !value || !std::isfinite(*value))
        refuse(*node, name, "a finite number", shown(*node), "Expressions belong into the other sections.");
      all.push_back({name, *value});
    }
    return all;
  }

  Source source(const std::string& name, const toml::node& node) const {
    const std::size_t line = node.source().begin.line;
    if (const auto number = node.value<double>(); number && node.is_number()) {
      char text[32];
      std::snprintf(text, sizeof text, "%.17g", *number);
      return {file_.path, line, name, text};
    }
    if (!node.is_string()) refuse(node, name, "an expression in quotes", shown(node), "Example: x = \"normal(0, 1)\".");
    return {file_.path, line, name, *node.value<std::string>()};
  }

  std::vector<Source> expressions(const std::string& key, bool must_be_there) {
    std::vector<Source> all;
    const toml::table* table = section(key);
    if (must_be_there && (table == nullptr || table->empty()))
      refuse_absence("[" + key + "]", "at least one state with its prior", "Example: x = \"normal(0, sqrt(5))\".");
    if (table == nullptr) return all;
    for (const auto& [name, node] : in_order(*table)) {
      claim(*node, name, key == "noise" ? "noise" : "state");
      all.push_back(source(name, *node));
    }
    return all;
  }

  void read_next() {
    const toml::table* table = section("next");
    std::map<std::string, Source> found;
    if (table != nullptr)
      for (const auto& [name, node] : in_order(*table)) {
        if (std::none_of(file_.states.begin(), file_.states.end(),
                         [&, &known = name](const Source& s) { return s.key == known; }))
          refuse(*node, "[next]", "a state of [states]", "\"" + name + "\"", "Give every state a prior in [states].");
        found.emplace(name, source(name, *node));
      }
    for (const Source& state : file_.states) {
      if (!found.contains(state.key))
        refuse_absence("[next]", "a right-hand side for the state \"" + state.key + "\"",
                       "Example: x = \"x + normal(0, 1)\".");
      file_.next.push_back(found.at(state.key));
    }
  }

  void read_observations() {
    const toml::table* table = section("observations");
    if (table == nullptr || table->empty())
      refuse_absence("[observations]", "at least one observation or log_likelihood", "Example: y = \"normal(x, 1)\".");
    for (const auto& [name, node] : in_order(*table)) {
      if (name == "log_likelihood") {
        file_.log_likelihood.push_back(source(name, *node));
        continue;
      }
      claim(*node, name, "observation");
      file_.observations.push_back(source(name, *node));
      if (file_.observations.back().text.empty() && !table->contains("log_likelihood"))
        refuse(*node, name, "normal(mean, sd) or angle(mean, sd)", "\"\"", "Or say it in log_likelihood = \"...\".");
    }
  }

  const toml::table& root_;
  TextFile file_;
  std::map<std::string, std::string> names_;
};

}  // namespace

TextFile parse_text_file(const std::string& path, const std::string& text) {
  try {
    const toml::table root = toml::parse(text, path);
    return Reader(path, root).read();
  } catch (const toml::parse_error& error) {
    throw Refusal(ExitCode::kBadData, {path + ":" + std::to_string(error.source().begin.line), "", "TOML",
                                       std::string(error.description()), kSections});
  }
}

}  // namespace mote::graph
