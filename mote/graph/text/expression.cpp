#include "mote/graph/text/expression.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "mote/base/refusal.hpp"
#include "mote/graph/text/tokens.hpp"

namespace mote::graph {
namespace {

const std::string kFunctions =
    "Functions are sqrt, exp, log, sin, cos, tan, atan, atan2, abs, min, max, wrap, normal and uniform.";
constexpr int kDeepest = 200;
constexpr double kMostFactors = 64;

using Unary = Node (*)(const Node&);
const std::map<std::string, Unary>& unary_functions() {
  static const std::map<std::string, Unary> all{
      {"sqrt", [](const Node& a) { return sqrt(a); }},         {"exp", [](const Node& a) { return exp(a); }},
      {"log", [](const Node& a) { return log(a); }},           {"sin", [](const Node& a) { return sin(a); }},
      {"cos", [](const Node& a) { return cos(a); }},           {"tan", [](const Node& a) { return tan(a); }},
      {"atan", [](const Node& a) { return atan(a); }},         {"abs", [](const Node& a) { return abs(a); }},
      {"wrap", [](const Node& a) { return numbers::wrap(a); }}};
  return all;
}

using Binary = Node (*)(const Node&, const Node&);
const std::map<std::string, Binary>& binary_functions() {
  static const std::map<std::string, Binary> all{
      {"atan2", [](const Node& a, const Node& b) { return atan2(a, b); }},
      {"min", [](const Node& a, const Node& b) { return select(less(a, b), a, b); }},
      {"max", [](const Node& a, const Node& b) { return select(less(a, b), b, a); }}};
  return all;
}

bool is_draw(const std::string& name) { return name == "normal" || name == "uniform"; }

bool is_function(const std::string& name) {
  return unary_functions().contains(name) || binary_functions().contains(name) || is_draw(name) || name == "angle";
}

std::optional<double> constant_named(const std::string& name) {
  if (name == "pi") return kPi;
  if (name == "e") return std::numbers::e;
  return std::nullopt;
}

/// a^n by squaring, n >= 1.
Node whole_power(const Node& a, int n) {
  if (n == 1) return a;
  const Node half = whole_power(a, n / 2);
  return n % 2 == 0 ? half * half : half * half * a;
}

Node power(const Node& a, const Node& b) {
  if (!b.is_constant()) return exp(b * log(a));
  const double n = b.constant();
  if (n == 0) return Node(1);
  if (n == 0.5) return sqrt(a);
  if (n != std::floor(n) || std::abs(n) > kMostFactors) return exp(b * log(a));
  const Node product = whole_power(a, static_cast<int>(std::abs(n)));
  return n > 0 ? product : Node(1) / product;
}

class Parser {
 public:
  Parser(const Source& source, const Vocabulary& vocabulary)
      : source_(source), vocabulary_(vocabulary), tokens_(tokens_of(source)) {}

  Node whole() {
    const Node node = sum();
    expect_end();
    return finite(node);
  }

  MaybeWrapped maybe_wrapped() {
    if (!is_one_call("wrap")) return {whole(), false};
    at_ = 2;
    const Node inner = sum();
    expect(")");
    expect_end();
    return {finite(inner), true};
  }

  ParsedLaw law() {
    const bool angle = is_one_call("angle");
    if (!angle && !is_one_call("normal"))
      refuse(tokens_[0], "normal(mean, sd) or angle(mean, sd), and nothing else", "Example: normal(x^2/20, sqrt(r)).");
    at_ = 2;
    ParsedLaw law{angle, finite(sum()), {}};
    expect(",");
    const Token at_sd = tokens_[at_];
    law.sd = finite(sum());
    expect(")");
    expect_end();
    if (law.sd.is_constant() && !(law.sd.constant() > 0))
      refuse(at_sd, "a standard deviation above 0", "A measurement without error has no density.",
             std::to_string(law.sd.constant()));
    return law;
  }

 private:
  const Token& token() const { return tokens_[at_]; }
  bool take(std::string_view symbol) {
    const bool found = token().kind == Token::Kind::kSymbol && token().text == symbol;
    if (found) ++at_;
    return found;
  }
  void expect(std::string_view symbol) {
    if (!take(symbol)) refuse(token(), "\"" + std::string(symbol) + "\"", kFunctions);
  }
  void expect_end() {
    if (token().kind != Token::Kind::kEnd) refuse(token(), "an operator or the end", "Operators are + - * / ^.");
  }

  /// Whether all of the text is one call of that function.
  bool is_one_call(const std::string& function) const {
    if (tokens_[0].text != function || tokens_[0].kind != Token::Kind::kName || tokens_[1].text != "(") return false;
    int depth = 0;
    for (std::size_t k = 1; k < tokens_.size(); ++k) {
      depth += tokens_[k].text == "(" ? 1 : tokens_[k].text == ")" ? -1 : 0;
      if (depth == 0) return tokens_[k + 1].kind == Token::Kind::kEnd;
    }
    return false;
  }

  Node sum() {
    if (++depth_ > kDeepest) refuse(token(), "at most 200 levels of brackets", "Write it in parts.");
    Node left = product();
    for (;;) {
      if (take("+")) {
        left = left + product();
      } else if (take("-")) {
        left = left - product();
      } else {
        --depth_;
        return left;
      }
    }
  }
  Node product() {
    Node left = with_sign();
    for (;;) {
      if (take("*")) {
        left = left * with_sign();
      } else if (take("/")) {
        left = left / with_sign();
      } else {
        return left;
      }
    }
  }
  Node with_sign() {
    bool negative = false;
    for (;;) {
      if (take("-")) {
        negative = !negative;
      } else if (!take("+")) {
        return negative ? -raised() : raised();
      }
    }
  }
  Node raised() {
    const Node base = primary();
    if (!take("^")) return base;
    if (++depth_ > kDeepest) refuse(token(), "at most 200 levels of brackets", "Write it in parts.");
    const Node exponent = with_sign();
    --depth_;
    return power(base, exponent);
  }
  Node primary() {
    const Token here = token();
    if (take("(")) {
      const Node inner = sum();
      expect(")");
      return inner;
    }
    if (here.kind == Token::Kind::kNumber) {
      ++at_;
      return Node(here.number);
    }
    if (here.kind != Token::Kind::kName) refuse(here, "a number, a name or \"(\"", kFunctions);
    ++at_;
    return token().text == "(" ? call(here) : named(here);
  }

  Node named(const Token& name) {
    const auto found = vocabulary_.names.find(name.text);
    if (found != vocabulary_.names.end()) return found->second;
    if (const auto constant = constant_named(name.text)) return Node(*constant);
    const auto elsewhere = vocabulary_.elsewhere.find(name.text);
    if (elsewhere != vocabulary_.elsewhere.end()) refuse(name, "a name that can be used here", elsewhere->second);
    if (is_function(name.text)) refuse(name, "a function with its arguments in brackets", kFunctions);
    refuse(name, "one of " + known_names(), kFunctions);
  }
  std::string known_names() const {
    std::string all;
    for (const auto& [name, node] : vocabulary_.names) all += name + ", ";
    return all + "pi, e";
  }

  Node call(const Token& function) {
    if (!is_function(function.text)) refuse(function, "a function", kFunctions);
    if (function.text == "angle")
      refuse(function, "angle(mean, sd) as the whole law of an observation", "Wrap an angle by wrap(a).");
    if (is_draw(function.text) && !vocabulary_.draw)
      refuse(function, "an expression without draws", "Draws belong into [states], [noise] and [next].");
    expect("(");
    std::vector<Node> arguments{sum()};
    while (take(",")) arguments.push_back(sum());
    expect(")");
    const std::size_t takes = unary_functions().contains(function.text) ? 1 : 2;
    if (arguments.size() != takes)
      refuse(function, takes == 1 ? "one argument" : "two arguments", kFunctions, std::to_string(arguments.size()));
    if (takes == 1) return unary_functions().at(function.text)(arguments[0]);
    if (!is_draw(function.text)) return binary_functions().at(function.text)(arguments[0], arguments[1]);
    const bool normal = function.text == "normal";
    const Node scale = normal ? arguments[1] : arguments[1] - arguments[0];
    return arguments[0] + scale * vocabulary_.draw(normal);
  }

  Node finite(const Node& node) const {
    if (node.is_constant() && !std::isfinite(node.constant()))
      refuse(tokens_[0], "a finite number", "Check it for divisions by zero, roots and logarithms.",
             std::to_string(node.constant()));
    return node;
  }

  [[noreturn]] void refuse(const Token& token, const std::string& expected, const std::string& next,
                           const std::string& got = "") const {
    refuse_token(source_, token, expected, got, next);
  }

  const Source& source_;
  const Vocabulary& vocabulary_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Node parse_expression(const Source& source, const Vocabulary& vocabulary) { return Parser(source, vocabulary).whole(); }

MaybeWrapped parse_maybe_wrapped(const Source& source, const Vocabulary& vocabulary) {
  return Parser(source, vocabulary).maybe_wrapped();
}

ParsedLaw parse_law(const Source& source, const Vocabulary& vocabulary) { return Parser(source, vocabulary).law(); }

bool is_free_name(std::string_view text) {
  const auto is_letter = [](unsigned char c) { return c == '_' || (c < 128 && std::isalpha(c) != 0); };
  return !text.empty() && is_letter(static_cast<unsigned char>(text.front())) &&
         std::all_of(text.begin(), text.end(), [&](unsigned char c) { return is_letter(c) || std::isdigit(c) != 0; }) &&
         !is_function(std::string(text)) && !constant_named(std::string(text)) && text != "t" &&
         text != "log_likelihood";
}

}  // namespace mote::graph
