#pragma once
/// Exchange: groups on a ring send their heaviest particles to the next group.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "mote/filter/options.hpp"
#include "mote/filter/particles.hpp"

namespace mote {

/// N particles cut into K contiguous groups whose sizes differ by at most one.
class Ring {
 public:
  Ring(std::size_t particles, std::size_t groups) : particles_(particles), groups_(groups) {}
  std::size_t groups() const { return groups_; }
  std::size_t first(std::size_t k) const { return k * (particles_ / groups_) + std::min(k, particles_ % groups_); }
  std::size_t size(std::size_t k) const { return first(k + 1) - first(k); }
  std::size_t before(std::size_t k) const { return (k + groups_ - 1) % groups_; }

 private:
  std::size_t particles_, groups_;
};

/// The M particles that each group receives: those of group k at [k M, (k + 1) M).
template <class R>
struct Inbox {
  std::size_t count = 0;
  Particles<R> x{0, 0};
  std::vector<double> log_weights;
};

/// The m heaviest (or lightest) particles of [first, first + n), ties by index.
inline std::vector<Index> extreme(std::span<const double> log_weights, std::size_t first, std::size_t n, std::size_t m,
                                  bool heaviest) {
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), static_cast<Index>(first));
  const auto before = [&](Index a, Index b) {
    const double la = log_weights[a];
    const double lb = log_weights[b];
    if (la != lb) return heaviest ? la > lb : la < lb;
    return heaviest ? a < b : a > b;  // so that heaviest and lightest never share a particle
  };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(m), order.end(), before);
  order.resize(m);
  return order;
}

/// Sends the heaviest M particles of every group to the next one, all groups at once.
///
///   swap     the particles change places, weights and all: the total weight is kept, nothing is biased
///   append   the receiver gets copies; sender and copy carry half the weight each: the total weight is kept
///   replace  as append, but the copies take the places of the receiver's lightest M, whose weight is lost
///
/// shape   M <= size of the smallest group (2 M for replace)
/// returns the copies for append; swap and replace are done in place and return an empty inbox
/// source  docs/filters.md (F23); PPF section 3.4.1
template <class R>
Inbox<R> send(Particles<R>& x, std::span<double> log_weights, const Ring& ring, const GroupOptions& options) {
  if (options.exchange == Exchange::kNone || ring.groups() < 2) return {};
  const std::size_t m = options.exchange_count;
  Inbox<R> inbox{m, Particles<R>(x.dimensions(), m * ring.groups()), std::vector<double>(m * ring.groups())};
  std::vector<std::vector<Index>> sent;
  for (std::size_t k = 0; k < ring.groups(); ++k)
    sent.push_back(extreme(log_weights, ring.first(k), ring.size(k), m, true));
  std::vector<std::vector<Index>> places = sent;
  if (options.exchange == Exchange::kReplace)
    for (std::size_t k = 0; k < ring.groups(); ++k)
      places[k] = extreme(log_weights, ring.first(k), ring.size(k), m, false);
  if (options.exchange != Exchange::kSwap)
    for (const auto& group : sent)
      for (const Index i : group) log_weights[i] -= std::log(2.0);
  for (std::size_t k = 0; k < ring.groups(); ++k)
    for (std::size_t j = 0; j < m; ++j) {
      const Index from = sent[ring.before(k)][j];
      inbox.log_weights[k * m + j] = log_weights[from];
      for (std::size_t d = 0; d < x.dimensions(); ++d) inbox.x.component(d)[k * m + j] = x.component(d)[from];
    }
  if (options.exchange == Exchange::kAppend) return inbox;
  for (std::size_t k = 0; k < ring.groups(); ++k)
    for (std::size_t j = 0; j < m; ++j) {
      log_weights[places[k][j]] = inbox.log_weights[k * m + j];
      for (std::size_t d = 0; d < x.dimensions(); ++d) x.component(d)[places[k][j]] = inbox.x.component(d)[k * m + j];
    }
  return {};
}

}  // namespace mote
