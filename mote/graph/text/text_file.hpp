#pragma once
/// A model as a TOML file of expressions.

#include <string>
#include <vector>

#include "mote/graph/text/expression.hpp"

namespace mote::graph {

/// A name with a number: a parameter or an input.
struct NamedNumber {
  std::string name;
  double value = 0;
};

/// What a model's file says, in its own order. The key of a source is the name that it defines.
struct TextFile {
  std::string path;
  std::string name;     ///< the file's stem if it gives none
  std::string meaning;  ///< "a model given as text" if it gives none
  std::vector<NamedNumber> parameters, inputs;
  std::vector<Source> states;          ///< priors
  std::vector<Source> noise;           ///< draws that several right-hand sides share
  std::vector<Source> next;            ///< by the order of the states
  std::vector<Source> observations;    ///< laws; an empty text: only log_likelihood speaks of it
  std::vector<Source> log_likelihood;  ///< none or one
};

/// Reads the text of a file.
///
///   name = "growth"                      optional, as is meaning = "..."
///   [parameters]                         numbers, which --set changes
///   [inputs]                             extra columns of the data, with the numbers they have without them
///   [states]                             x = "normal(0, sqrt(5))": draws from the prior, in the state's order
///   [noise]                              u = "normal(0, s)": one draw that several right-hand sides of [next] share
///   [next]                               x = "0.5*x + normal(0, 1)": the previous state, t and noise
///   [observations]                       y = "normal(x, 1)" or "angle(x, 0.1)"; log_likelihood = "..." instead
///
/// error   Refusal (kBadData) naming file:line and what was found there
TextFile parse_text_file(const std::string& path, const std::string& text);

}  // namespace mote::graph
