#include "mote/app/terminal/suggestion.hpp"

#include <algorithm>
#include <numeric>

namespace mote {
namespace {

/// Levenshtein's distance.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (letter == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 64;
  if (word.empty() || word.size() > kLongest) return "";
  const auto begins = [&](const std::string& k) { return k.starts_with(word); };
  if (std::count_if(known.begin(), known.end(), begins) == 1) return *std::find_if(known.begin(), known.end(), begins);
  std::string best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t d = distance(word, candidate);
    if (d >= std::min(least, candidate.size())) continue;
    least = d;
    best = candidate;
  }
  return best;
}

std::string hint(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise) {
  const std::string meant = nearest(word, known);
  return meant.empty() ? otherwise : "Did you mean " + meant + "?";
}

}  // namespace mote
