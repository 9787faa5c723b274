#pragma once
/// The words of an expression.

#include <string>
#include <vector>

namespace mote::graph {

struct Source;

/// A word of an expression.
struct Token {
  enum class Kind { kNumber, kName, kSymbol, kEnd };
  Kind kind;
  std::string text;
  double number = 0;
  std::size_t line = 0;  ///< below the expression's first
};

/// The words of an expression; the last one is its end.
///
/// error   Refusal (kBadData) for a character that belongs to no word
std::vector<Token> tokens_of(const Source& source);

/// Refuses a token: "file:line: "token" in key: expected ..., got ..."; without `got`, the token is what was got.
///
/// error   always: Refusal (kBadData)
[[noreturn]] void refuse_token(const Source& source, const Token& token, const std::string& expected,
                               const std::string& got, const std::string& next);

}  // namespace mote::graph
