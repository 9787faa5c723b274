#pragma once
/// Facts: what numbers come from, by name, as text; kept beside them, so that none are taken for those of another run.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mote/engine/recording.hpp"

namespace mote {

/// What decides a run's numbers: two runs with the same facts are the same run.
using RunFacts = std::vector<std::pair<std::string, std::string>>;

/// A number in hexadecimal that nearly every change of a text changes.
std::string checksum_of(std::string_view text);

/// A recording as a fact: its steps, and the checksum of all that a filter sees of them.
std::string summed_up(const Recording& recording);

/// The program's version, the model, its settings, and what is in the files that these name.
///
/// error   as read_text()
RunFacts model_facts(const std::string& model, std::vector<std::string> settings);

/// The first fact of ours that theirs are without, and theirs in its place, each as "name value".
std::optional<std::pair<std::string, std::string>> difference(const RunFacts& ours, const RunFacts& theirs);

}  // namespace mote
