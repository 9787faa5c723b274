#include "mote/analog/translinear.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace mote::analog {
namespace {

// arctan(x) ~ (pi/2) x / (kOffset + sqrt(kSquare + x^2)), MIXED's reference [3]
constexpr double kOffset = 0.63, kSquare = 0.88;
// exp(-x^2/2) ~ 1 / (1 + kA x^2 + kB x^4): kB sets the power (kB x^4 flows at x = 10), kA is the least squares for it
constexpr double kA = 0.5684, kB = 0.15;

/// x+ - x- = I_in, x+ x- = c I_a^2; their squares flow out of the node "squares".
///
/// shape   width: of x+ and x-, so that large inputs stay in weak inversion; the widths of a loop cancel
Translinear splitter(Function function, double c, double width) {
  const double square = width * width;
  return {function,
          {{"unit", "unit", {"unit", "unit"}},
           {"plus", "plus", {"plus", "unit"}, width},
           {"pair", "minus", {"plus", "minus"}, square},
           {"minus", "feed", {"minus", "unit"}, width},
           {"plus.square", "squares", {"plus", "plus"}, square},
           {"minus.square", "squares", {"minus", "minus"}, square}},
          {{"unit", 1}, {"minus", c}},
          {{"feed", "plus"}},
          "plus",
          "out"};
}

void append(Translinear& circuit, const std::vector<Mite>& mites, const std::vector<Bias>& biases,
            const std::vector<Mirror>& mirrors) {
  circuit.mites.insert(circuit.mites.end(), mites.begin(), mites.end());
  circuit.biases.insert(circuit.biases.end(), biases.begin(), biases.end());
  circuit.mirrors.insert(circuit.mirrors.end(), mirrors.begin(), mirrors.end());
}

Translinear arctan() {
  Translinear circuit = splitter(Function::kArctan, kSquare / 2, 1);
  append(circuit,
         {{"radicand", "radicand", {"radicand", "radicand"}},
          {"root", "root", {"radicand", "unit"}},
          {"denominator", "denominator", {"denominator", "denominator"}},
          {"scale", "scale", {"scale", "denominator"}},
          {"inverse", "inverse", {"scale", "scale"}},
          {"factor", "factor", {"factor", "unit"}},
          {"out.plus", "positive", {"plus", "factor"}},
          {"out.minus", "out", {"minus", "factor"}}},
         {{"denominator", kOffset}, {"scale", std::sqrt(std::numbers::pi / 2)}},
         {{"squares", "radicand"}, {"root", "denominator"}, {"inverse", "factor"}, {"positive", "out"}});
  return circuit;
}

Translinear gaussian() {
  // widths of what carries b x^4 and its roots
  constexpr double kSplit = 2, kSquared = 3, kDenominator = 16;
  Translinear circuit = splitter(Function::kGaussian, kA / (4 * kB), kSplit);
  append(circuit,
         {{"scaled", "scaled", {"scaled", "unit"}, kSquared},
          {"fourth", "fourth", {"scaled", "scaled"}, kSquared * kSquared},
          {"denominator", "denominator", {"denominator", "denominator"}, kDenominator},
          {"scale", "scale", {"scale", "denominator"}, std::sqrt(kDenominator)},
          {"inverse", "inverse", {"scale", "scale"}}},
         {{"denominator", 1 - kA * kA / (4 * kB)}, {"scale", 1}},
         {{"squares", "scaled", std::sqrt(kB)}, {"fourth", "denominator"}, {"inverse", "out"}});
  return circuit;
}

/// Gates as numbers: how often each MITE has each node as a gate, and itself noted beside.
std::vector<std::vector<int>> incidence(const Translinear& circuit) {
  std::vector<std::string> nodes;
  std::vector<std::vector<int>> rows;
  for (const Mite& mite : circuit.mites)
    for (const std::string& gate : mite.gates)
      if (std::find(nodes.begin(), nodes.end(), gate) == nodes.end()) nodes.push_back(gate);
  for (std::size_t k = 0; k < circuit.mites.size(); ++k) {
    std::vector<int> row(nodes.size() + circuit.mites.size(), 0);
    for (const std::string& gate : circuit.mites[k].gates)
      ++row[static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), gate) - nodes.begin())];
    row[nodes.size() + k] = 1;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// row - what of pivot makes its entry at `column` vanish, in the smallest integers.
void eliminate(std::vector<int>& row, const std::vector<int>& pivot, std::size_t column) {
  const int mine = row[column];
  int divisor = 0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    row[k] = row[k] * pivot[column] - pivot[k] * mine;
    divisor = std::gcd(divisor, row[k]);
  }
  if (divisor > 1)
    for (int& entry : row) entry /= divisor;
}

}  // namespace

Translinear translinear(Function function) { return function == Function::kArctan ? arctan() : gaussian(); }

double approximation(Function function, double x) {
  if (function == Function::kArctan) return std::numbers::pi / 2 * x / (kOffset + std::sqrt(kSquare + x * x));
  return 1 / (1 + x * x * (kA + kB * x * x));
}

std::vector<std::vector<int>> loops(const Translinear& circuit) {
  std::vector<std::vector<int>> rows = incidence(circuit);
  const std::size_t nodes = rows.front().size() - rows.size();
  std::size_t rank = 0;
  for (std::size_t column = 0; column < nodes; ++column) {
    std::size_t pivot = rank;
    while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[rank], rows[pivot]);
    for (std::size_t k = rank + 1; k < rows.size(); ++k)
      if (rows[k][column] != 0) eliminate(rows[k], rows[rank], column);
    ++rank;
  }
  std::vector<std::vector<int>> found;
  for (std::size_t k = rank; k < rows.size(); ++k)
    found.emplace_back(rows[k].begin() + static_cast<std::ptrdiff_t>(nodes), rows[k].end());
  return found;
}

std::vector<std::string> devices(const Translinear& circuit) {
  std::vector<std::string> names;
  for (const Mite& mite : circuit.mites) names.push_back(mite.name);
  names.emplace_back("reference");
  for (const Bias& bias : circuit.biases) names.push_back("bias." + bias.node);
  for (const Mirror& mirror : circuit.mirrors) {
    names.push_back("in." + mirror.from);
    names.push_back("out." + mirror.from);
  }
  return names;
}

}  // namespace mote::analog
