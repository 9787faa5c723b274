#pragma once
/// Expressions in text, as a graph.
///
///   sum      = product { ("+" | "-") product }
///   product  = signed { ("*" | "/") signed }
///   signed   = ("+" | "-") signed | power
///   power    = primary [ "^" signed ]
///   primary  = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
///
/// So -x^2 is -(x^2) and a^b^c is a^(b^c). Names are the caller's, and pi and e. Functions: sqrt exp log sin cos tan
/// atan abs wrap of one argument, atan2 min max of two; normal(mean, sd) and uniform(from, to) where draws are allowed.

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mote/graph/node.hpp"

namespace mote::graph {

/// Where an expression stands: what a refusal opens with.
struct Source {
  std::string file;
  std::size_t line = 0;
  std::string key;  ///< what it defines
  std::string text;
};

/// What an expression may use.
struct Vocabulary {
  std::map<std::string, Node> names;
  std::map<std::string, std::string> elsewhere;  ///< names that exist, but not here: why
  std::function<Node(bool normal)> draw = {};    ///< empty: nothing may be drawn here
};

/// The value of an expression.
///
///   a^b = a a ... a for whole b up to 64, 1 / a^-b below 0, sqrt(a) for 1/2, else exp(b log a), which asks for a > 0
///
/// error   Refusal (kBadData) naming file:line and the token
Node parse_expression(const Source& source, const Vocabulary& vocabulary);

/// An expression that may be a wrapped angle, wrap(angle): the angle before, and whether it is wrapped.
struct MaybeWrapped {
  Node inner;
  bool wrapped = false;
};
MaybeWrapped parse_maybe_wrapped(const Source& source, const Vocabulary& vocabulary);

/// The law of an observation, normal(mean, sd) or angle(mean, sd).
struct ParsedLaw {
  bool angle = false;
  Node mean, sd;
};
ParsedLaw parse_law(const Source& source, const Vocabulary& vocabulary);

/// Whether a text can be a name: letters, digits and _, a letter or _ first, and no word of this language.
bool is_free_name(std::string_view text);

}  // namespace mote::graph
