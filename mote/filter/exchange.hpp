#pragma once
/// Exchange: groups send particles to their neighbours.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "mote/filter/particles.hpp"
#include "mote/filter/topology.hpp"
#include "mote/filter/traffic.hpp"

namespace mote {

/// The particles that each group receives: those of group k at [k count, (k + 1) count).
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

/// m particles of [first, first + n), evenly spread: the middles of m equal parts.
inline std::vector<Index> evenly_spread(std::size_t first, std::size_t n, std::size_t m) {
  std::vector<Index> places;
  for (std::size_t j = 0; j < m; ++j) places.push_back(static_cast<Index>(first + (2 * j + 1) * n / (2 * m)));
  return places;
}

/// Particles by group.
using ByGroup = std::vector<std::vector<Index>>;

/// What arrives at each group when each deals the particles that it sends out to its neighbours, one to each in turn.
///
/// shape   sent: (K, M degree), sender by sender; out: the same, receiver by receiver
inline ByGroup dealt(const ByGroup& sent, Topology topology, std::size_t turn) {
  ByGroup arriving(sent.size());
  for (std::size_t k = 0; k < sent.size(); ++k) {
    const std::vector<std::size_t> to = neighbours(topology, sent.size(), k, turn);
    for (std::size_t q = 0; q < to.size(); ++q)
      for (std::size_t rank = q; rank < sent[k].size(); rank += to.size()) arriving[to[q]].push_back(sent[k][rank]);
  }
  return arriving;
}

/// Copies of the arriving particles, with their weights.
template <class R>
Inbox<R> collected(const Particles<R>& x, std::span<const double> log_weights, const ByGroup& arriving) {
  const std::size_t count = arriving.front().size();
  Inbox<R> inbox{count, Particles<R>(x.dimensions(), count * arriving.size()), {}};
  std::size_t to = 0;
  for (const auto& group : arriving)
    for (const Index from : group) {
      inbox.log_weights.push_back(log_weights[from]);
      for (std::size_t d = 0; d < x.dimensions(); ++d) inbox.x.component(d)[to] = x.component(d)[from];
      ++to;
    }
  return inbox;
}

/// Puts what each group received into the given places.
template <class R>
void put(const Inbox<R>& inbox, const ByGroup& places, Particles<R>& x, std::span<double> log_weights) {
  std::size_t from = 0;
  for (const auto& group : places)
    for (const Index to : group) {
      log_weights[to] = inbox.log_weights[from];
      for (std::size_t d = 0; d < x.dimensions(); ++d) x.component(d)[to] = inbox.x.component(d)[from];
      ++from;
    }
}

/// Each group sends its heaviest particles, M to each neighbour: the heaviest to the first, the next to the second, ...
/// All groups at once.
///
///   swap     the particles change places, weights and all: the total weight is kept, nothing is biased
///   append   the receiver gets copies; sender and copy carry half the weight each: the total weight is kept
///   replace  as append, but the copies take the places of the receiver's lightest, whose weight is lost
///
/// shape   M degree <= size of the smallest group (2 M degree for replace)
/// returns the copies for append; swap and replace are done in place and return an empty inbox
/// source  docs/filters.md (F23); PPF section 3.4.1
template <class R>
Inbox<R> send(Particles<R>& x, std::span<double> log_weights, const Groups& groups, const GroupOptions& options,
              std::size_t turn) {
  const std::size_t m = options.exchange_count * degree(options.topology, groups.count());
  const auto extremes = [&](bool heaviest) {
    ByGroup all;
    for (std::size_t k = 0; k < groups.count(); ++k)
      all.push_back(extreme(log_weights, groups.first(k), groups.size(k), m, heaviest));
    return all;
  };
  const ByGroup sent = extremes(true);
  const ByGroup places = options.exchange == Exchange::kReplace ? extremes(false) : sent;
  if (options.exchange != Exchange::kSwap)
    for (const auto& group : sent)
      for (const Index i : group) log_weights[i] -= std::log(2.0);
  Inbox<R> inbox = collected(x, log_weights, dealt(sent, options.topology, turn));
  if (options.exchange == Exchange::kAppend) return inbox;
  put(inbox, places, x, log_weights);
  return {};
}

/// M particles for each neighbour, evenly spread over the group, change places with the neighbours', weights and all.
///
/// source  docs/filters.md (F24c); Bolic, Djuric & Hong 2005: RNA with local exchange
template <class R>
void trade_evenly(Particles<R>& x, std::span<double> log_weights, const Groups& groups, const GroupOptions& options,
                  std::size_t turn) {
  const std::size_t m = options.exchange_count * degree(options.topology, groups.count());
  ByGroup sent;
  for (std::size_t k = 0; k < groups.count(); ++k) sent.push_back(evenly_spread(groups.first(k), groups.size(k), m));
  put(collected(x, log_weights, dealt(sent, options.topology, turn)), sent, x, log_weights);
}

/// What an exchange sends: to each neighbour one message of M particles, state and weight.
template <class R>
Traffic exchanged(const GroupOptions& options, std::size_t dimensions) {
  const auto messages = static_cast<double>(options.groups * degree(options.topology, options.groups));
  const auto particle = static_cast<double>(dimensions * sizeof(R) + sizeof(double));
  return {messages, messages * static_cast<double>(options.exchange_count) * particle};
}

}  // namespace mote
