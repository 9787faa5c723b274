#include "mote/hardware/lowering.hpp"

#include <map>
#include <regex>
#include <stdexcept>
#include <vector>

namespace mote::hardware {
namespace {

/// Behind the bracket that closes the one at `open`.
std::size_t closed(const std::string& text, std::size_t open, char left, char right) {
  int depth = 0;
  for (std::size_t at = open; at < text.size(); ++at) {
    depth += text[at] == left ? 1 : text[at] == right ? -1 : 0;
    if (depth == 0) return at + 1;
  }
  throw std::logic_error("a bracket that nothing closes");
}

/// What stands in the brackets from `at` on; `at` is moved behind them.
std::vector<std::string> bracketed(const std::string& text, std::size_t& at) {
  std::vector<std::string> inside;
  while (at < text.size() && text[at] == '[') {
    const std::size_t end = closed(text, at, '[', ']');
    inside.push_back(text.substr(at + 1, end - at - 2));
    at = end;
  }
  return inside;
}

/// The bits of a range "A:0".
std::string width_of(const std::string& range) { return "((" + range.substr(0, range.rfind(':')) + ")+1)"; }

std::string product(const std::vector<std::string>& factors, std::size_t from) {
  std::string text = from >= factors.size() ? "1" : factors[from];
  for (std::size_t k = from + 1; k < factors.size(); ++k) text += "*" + factors[k];
  return text;
}

/// Calls change(match), which gives what stands there instead, for every match that is left of a pattern.
template <class Change>
void replace_all(std::string& text, const std::regex& pattern, Change change) {
  std::string done;
  std::smatch match;
  while (std::regex_search(text, match, pattern)) {
    const std::string before = match.prefix();
    std::string after = match.suffix();
    done += before + change(match, after);
    text = std::move(after);
  }
  text = done + text;
}

/// name'(x) as a cast by width, with the sign of the type.
void replace_casts(std::string& text, const std::string& name, bool sign, const std::string& width) {
  const std::string opening = name + "'(";
  for (std::size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at)) {
    const std::size_t open = at + opening.size() - 1;
    const std::size_t end = closed(text, open, '(', ')');
    const std::string cast = (sign ? "$signed(" : "$unsigned(") + width + "'" + text.substr(open, end - open) + ")";
    text.replace(at, end - at, cast);
  }
}

void remove_types(std::string& text) {
  static const std::regex kType(R"(\btypedef logic( signed)? \[([^\n]*:0)\] (\w+);)");
  std::smatch match;
  while (std::regex_search(text, match, kType)) {
    const bool sign = match[1].matched;
    const std::string range = match[2];
    const std::string name = match[3];
    text.replace(static_cast<std::size_t>(match.position()), static_cast<std::size_t>(match.length()), "");
    replace_casts(text, name, sign, width_of(range));
    const std::string word = "\\b" + name + "\\b";
    replace_all(text, std::regex(word + "\\s*(?=\\[)"), [&](const std::smatch&, std::string& after) {
      std::size_t at = 0;
      bracketed(after, at);
      const std::string ranges = after.substr(0, at);
      after = after.substr(at);
      return "logic " + ranges + "[" + range + "]";  // elements have no sign
    });
    text =
        std::regex_replace(text, std::regex(word), std::string("logic") + (sign ? " signed" : "") + " [" + range + "]");
  }
}

void remove_returns(std::string& text) {
  static const std::regex kFunction(R"(\bfunction automatic [^;]*?(\w+)\()");
  replace_all(text, kFunction, [](const std::smatch& match, std::string& after) {
    const std::size_t end = after.find("endfunction");
    const std::string body =
        std::regex_replace(after.substr(0, end), std::regex("\\breturn\\b"), match[1].str() + " =");
    after = after.substr(end);
    return match.str() + body;
  });
}

using Shapes = std::map<std::string, std::vector<std::string>>;  // widths by name

/// Makes declarations flat; says what they were.
Shapes flatten_declarations(std::string& text) {
  static const std::regex kStart(R"(\blogic( signed)?\s*(?=\[))");
  static const std::regex kNames(R"(^\s*(\w+(?:\s*,\s*(?!input|output|logic)\w+)*))");
  Shapes shapes;
  replace_all(text, kStart, [&](const std::smatch& match, std::string& after) {
    std::size_t at = 0;
    const std::vector<std::string> ranges = bracketed(after, at);
    if (ranges.size() < 2) return match.str();
    std::vector<std::string> widths;
    for (const std::string& range : ranges) widths.push_back(width_of(range));
    after = after.substr(at);
    std::smatch names;
    std::regex_search(after, names, kNames);
    const std::string list = names[1];
    static const std::regex kName(R"(\w+)");
    for (std::sregex_iterator name(list.begin(), list.end(), kName), end; name != end; ++name)
      shapes[name->str()] = widths;
    return match.str() + "[" + product(widths, 0) + "-1:0]";
  });
  return shapes;
}

/// The part of a flat vector that indices of an array name.
std::string part(const std::vector<std::string>& widths, const std::vector<std::string>& indices) {
  std::string base = "0";
  const std::size_t elements = std::min(indices.size(), widths.size() - 1);
  for (std::size_t k = 0; k < elements; ++k) {
    if (indices[k].find(':') != std::string::npos && indices[k].find('?') == std::string::npos)
      throw std::logic_error("a slice of elements: [" + indices[k] + "]");
    base += "+(" + indices[k] + ")*" + product(widths, k + 1);
  }
  if (elements == indices.size()) return "[" + base + " +: " + product(widths, elements) + "]";
  const std::string& bits = indices[elements];
  for (const char* direction : {"+:", "-:"})
    if (const auto sign = bits.find(direction); sign != std::string::npos)
      return "[" + base + "+(" + bits.substr(0, sign) + ") " + direction + " " + bits.substr(sign + 2) + "]";
  if (const auto colon = bits.rfind(':'); colon != std::string::npos && bits.find('?') == std::string::npos) {
    const std::string low = bits.substr(colon + 1);
    return "[" + base + "+(" + low + ") +: (" + bits.substr(0, colon) + ")-(" + low + ")+1]";
  }
  return "[" + base + "+(" + bits + ")]";
}

std::string with_flat_uses(std::string text, const Shapes& shapes) {
  static const std::regex kIndexed(R"(\b(\w+)(?=\[))");
  replace_all(text, kIndexed, [&](const std::smatch& match, std::string& after) {
    const auto shape = shapes.find(match[1]);
    if (shape == shapes.end()) return match.str();
    std::size_t at = 0;
    std::vector<std::string> indices = bracketed(after, at);
    for (std::string& index : indices) index = with_flat_uses(index, shapes);
    after = after.substr(at);
    return match.str() + part(shape->second, indices);
  });
  return text;
}

}  // namespace

std::string lowered(std::string text) {
  remove_types(text);
  remove_returns(text);
  const Shapes shapes = flatten_declarations(text);
  return with_flat_uses(std::move(text), shapes);
}

}  // namespace mote::hardware
