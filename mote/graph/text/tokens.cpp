#include "mote/graph/text/tokens.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include "mote/base/refusal.hpp"
#include "mote/graph/text/expression.hpp"

namespace mote::graph {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool in_name(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; }

}  // namespace

void refuse_token(const Source& source, const Token& token, const std::string& expected, const std::string& got,
                  const std::string& next) {
  const std::string shown = token.kind == Token::Kind::kEnd ? "the end" : "\"" + token.text + "\"";
  const std::string where = source.file + ":" + std::to_string(source.line + token.line);
  if (got.empty()) throw Refusal(ExitCode::kBadData, {where, source.key, expected, shown, next});
  throw Refusal(ExitCode::kBadData, {where, source.key + ": " + shown, expected, got, next});
}

std::vector<Token> tokens_of(const Source& source) {
  std::vector<Token> tokens;
  const std::string_view text = source.text;
  std::size_t line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    Token token{Token::Kind::kSymbol, std::string(1, c), 0, line};
    std::size_t length = 1;
    if (c == '\n') ++line;
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++at;
      continue;
    }
    if (is_digit(c) || c == '.') {
      const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), token.number);
      length = std::max<std::size_t>(1, static_cast<std::size_t>(end - (text.data() + at)));
      token = {Token::Kind::kNumber, std::string(text.substr(at, length)), token.number, line};
      if (error != std::errc() || !std::isfinite(token.number))
        refuse_token(source, token, "a number", "", "Numbers are written 25, 0.05 or 1e-3.");
    } else if (c == '_' || std::isalpha(static_cast<unsigned char>(c)) != 0) {
      while (at + length < text.size() && in_name(text[at + length])) ++length;
      token = {Token::Kind::kName, std::string(text.substr(at, length)), 0, line};
    } else if (std::string_view("+-*/^(),").find(c) == std::string_view::npos) {
      refuse_token(source, token, "numbers, names and the signs + - * / ^ ( ) ,", "", "Powers are written x^2.");
    }
    tokens.push_back(std::move(token));
    at += length;
  }
  tokens.push_back({Token::Kind::kEnd, "", 0, line});
  return tokens;
}

}  // namespace mote::graph
