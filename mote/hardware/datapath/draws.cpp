#include "mote/hardware/datapath/draws.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mote/base/normal.hpp"
#include "mote/hardware/lookup.hpp"
#include "mote/hardware/random.hpp"

namespace mote::hardware {
namespace {

/// Bits that a table's numbers have below the sum's last.
constexpr int kGuard = 2;

constexpr int bits_of_draw(bool prior) { return prior ? kPriorBits : kMoveBits; }

/// The bits of a draw, unsigned.
std::uint32_t bits_of_word(std::uint32_t word, bool prior) {
  return prior ? word & ((1U << kPriorBits) - 1) : word >> (32 - kMoveBits);
}

/// A table and the bits of a draw that choose from it.
struct Term {
  int first, bits;
  std::vector<double> numbers;
};

double mean_power(const std::vector<double>& numbers, int power) {
  double sum = 0;
  for (const double number : numbers) sum += std::pow(number, power);
  return sum / static_cast<double>(numbers.size());
}

/// 2^bits quantiles q + b q^3, scaled to a variance of 1.
std::vector<double> bent_quantiles(int bits, double bend) {
  std::vector<double> numbers;
  for (int k = 0; k < 1 << bits; ++k) {
    const double q = standard_normal_quantile(std::ldexp(k + 0.5, -bits));
    numbers.push_back(q + bend * q * q * q);
  }
  const double deviation = std::sqrt(mean_power(numbers, 2));
  for (double& number : numbers) number /= deviation;
  return numbers;
}

/// Numbers of that variance and of kurtosis 3, by bisection of the bend.
std::vector<double> near_normal(int bits, double variance) {
  double low = 0;
  double high = 1;
  for (int turn = 0; turn < 50; ++turn) {
    const double middle = (low + high) / 2;
    (mean_power(bent_quantiles(bits, middle), 4) < 3 ? low : high) = middle;
  }
  std::vector<double> numbers = bent_quantiles(bits, low);
  for (double& number : numbers) number *= std::sqrt(variance);
  return numbers;
}

const std::vector<Term>& terms_of(bool prior) {
  static const std::vector<Term> of_prior{{0, 7, near_normal(7, 2.0 / 5)}, {7, 7, near_normal(7, 3.0 / 5)}};
  static const std::vector<Term> of_move{
      {0, 6, near_normal(6, 3.0 / 12)}, {6, 6, near_normal(6, 4.0 / 12)}, {12, 6, near_normal(6, 5.0 / 12)}};
  return prior ? of_prior : of_move;
}

/// A table of scaled numbers and an offset as words.
Lookup table_of(const Term& term, double scale, double offset, int fraction) {
  Format y{true, -fraction, fraction};
  const double most = std::abs(scale) * term.numbers.back() + offset;
  while (y.value(y.greatest()) < most) ++y.integer;
  std::vector<Word> words;
  for (const double number : term.numbers) words.push_back(y.nearest(scale * number + offset));
  return {{false, term.bits, 0}, y, std::move(words)};
}

}  // namespace

double normal_draw(std::uint32_t word, bool prior) {
  const std::uint32_t bits = bits_of_word(word, prior);
  double sum = 0;
  for (const Term& term : terms_of(prior)) sum += term.numbers[(bits >> term.first) & ((1U << term.bits) - 1)];
  return sum;
}

double uniform_draw(std::uint32_t word, bool prior) {
  return std::ldexp(static_cast<double>(bits_of_word(word, prior)), -bits_of_draw(prior));
}

Signal WordDraws::normal(const Signal& word, bool prior, double scale, const Format& y) const {
  const std::vector<Term>& terms = terms_of(prior);
  const auto number = [&](const Term& term) {
    const double offset = term.first == 0 ? y.step() / 2 : 0;  // rounds the sum
    const Lookup table = table_of(term, scale, offset, y.fraction + kGuard);
    return sketch_.op(table, table.y(), sketch_.bits(word, (prior ? 0 : 32 - kMoveBits) + term.first, term.bits));
  };
  Signal sum = number(terms.front());
  for (std::size_t k = 1; k < terms.size(); ++k) {
    const Signal next = number(terms[k]);
    const Format exact{true, std::max(sum.format.integer, next.format.integer) + 1, next.format.fraction};
    sum = sketch_.sum(sum, next, k + 1 < terms.size() ? exact : y, Rounding::kDown);
  }
  return sum;
}

Signal WordDraws::uniform(const Signal& word, bool prior, const Format& y) const {
  const int bits = bits_of_draw(prior);
  return sketch_.convert(sketch_.bits(word, prior ? 0 : 32 - bits, bits, bits), y);
}

}  // namespace mote::hardware
