#pragma once
/// What a misspelt word may have meant.

#include <string>
#include <vector>

namespace mote {

/// The word of `known` that is nearest to `word` by single letters changed, added or left out (one for every three
/// letters at most), or the only one that begins with it; empty when none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// "Did you mean X?", or `otherwise` when nothing is near.
std::string hint(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise);

}  // namespace mote
