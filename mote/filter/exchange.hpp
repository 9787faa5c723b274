#pragma once
/// Exchange: groups send particles to their neighbours.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "mote/filter/membership.hpp"
#include "mote/filter/particles.hpp"
#include "mote/filter/traffic.hpp"

namespace mote {

/// The particles that each group here receives: those of the k-th of them at [k count, (k + 1) count).
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

/// Particles by group, of those here.
using ByGroup = std::vector<std::vector<Index>>;

/// Copies of particles with their weights, as bytes.
template <class R>
Letter letter_of(const Particles<R>& x, std::span<const double> log_weights, std::span<const Index> particles) {
  Letter letter{0, 0, {}};
  const auto write = [&](const auto& number) {
    const auto bytes = std::as_bytes(std::span(&number, 1));
    letter.bytes.insert(letter.bytes.end(), bytes.begin(), bytes.end());
  };
  for (const Index i : particles) {
    for (std::size_t d = 0; d < x.dimensions(); ++d) write(x.component(d)[i]);
    write(log_weights[i]);
  }
  return letter;
}
/// Takes the particles of a letter in, from place `to` on.
template <class R>
void take_in(const Letter& letter, std::size_t to, Particles<R>& x, std::span<double> log_weights) {
  const std::byte* from = letter.bytes.data();
  const auto read = [&](auto& number) {
    std::memcpy(&number, from, sizeof number);
    from += sizeof number;
  };
  for (; from != letter.bytes.data() + letter.bytes.size(); ++to) {
    for (std::size_t d = 0; d < x.dimensions(); ++d) read(x.component(d)[to]);
    read(log_weights[to]);
  }
}

/// What arrives at each group here when each deals the particles that it sends out to its neighbours, one to each in
/// turn. Letters arrive in the order of their senders.
///
/// shape   sent: (groups here, M degree)
template <class R>
Inbox<R> dealt(const Particles<R>& x, std::span<const double> log_weights, const ByGroup& sent,
               const Membership& members, const GroupOptions& options, std::size_t turn) {
  const std::size_t all = members.groups().count();
  const std::size_t here = members.end() - members.begin();
  const std::size_t count = options.exchange_count * degree(options.topology, all);
  Inbox<R> inbox{count, Particles<R>(x.dimensions(), count * here), std::vector<double>(count * here)};
  std::vector<std::size_t> taken(here);
  std::vector<Letter> out;
  std::vector<Letter> in;
  std::vector<std::size_t> places;  // of those that come in
  const auto next_place = [&](std::size_t group) {
    std::size_t& at = taken[group - members.begin()];
    at += options.exchange_count;
    return (group - members.begin()) * count + at - options.exchange_count;
  };
  for (std::size_t k = 0; k < all; ++k) {
    const std::vector<std::size_t> to = neighbours(options.topology, all, k, turn);
    for (std::size_t q = 0; q < to.size(); ++q) {
      if (members.has(k)) {
        const std::vector<Index>& mine = sent[k - members.begin()];
        std::vector<Index> picked;
        for (std::size_t rank = q; rank < mine.size(); rank += to.size()) picked.push_back(mine[rank]);
        Letter letter = letter_of(x, log_weights, picked);
        letter.from = k;
        letter.to = to[q];
        if (members.has(to[q]))
          take_in(letter, next_place(to[q]), inbox.x, inbox.log_weights);
        else
          out.push_back(std::move(letter));
      } else if (members.has(to[q])) {
        const std::size_t bytes = options.exchange_count * (x.dimensions() * sizeof(R) + sizeof(double));
        in.push_back({k, to[q], std::vector<std::byte>(bytes)});
        places.push_back(next_place(to[q]));
      }
    }
  }
  members.carry(out, in);
  for (std::size_t j = 0; j < in.size(); ++j) take_in(in[j], places[j], inbox.x, inbox.log_weights);
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
Inbox<R> send(Particles<R>& x, std::span<double> log_weights, const Membership& members, const GroupOptions& options,
              std::size_t turn) {
  const std::size_t m = options.exchange_count * degree(options.topology, members.groups().count());
  const auto extremes = [&](bool heaviest) {
    ByGroup all;
    for (std::size_t k = members.begin(); k < members.end(); ++k)
      all.push_back(extreme(log_weights, members.first(k), members.size(k), m, heaviest));
    return all;
  };
  const ByGroup sent = extremes(true);
  const ByGroup places = options.exchange == Exchange::kReplace ? extremes(false) : sent;
  if (options.exchange != Exchange::kSwap)
    for (const auto& group : sent)
      for (const Index i : group) log_weights[i] -= std::log(2.0);
  Inbox<R> inbox = dealt(x, log_weights, sent, members, options, turn);
  if (options.exchange == Exchange::kAppend) return inbox;
  put(inbox, places, x, log_weights);
  return {};
}

/// M particles for each neighbour, evenly spread over the group, change places with the neighbours', weights and all.
///
/// source  docs/filters.md (F24c); Bolic, Djuric & Hong 2005: RNA with local exchange
template <class R>
void trade_evenly(Particles<R>& x, std::span<double> log_weights, const Membership& members,
                  const GroupOptions& options, std::size_t turn) {
  const std::size_t m = options.exchange_count * degree(options.topology, members.groups().count());
  ByGroup sent;
  for (std::size_t k = members.begin(); k < members.end(); ++k)
    sent.push_back(evenly_spread(members.first(k), members.size(k), m));
  put(dealt(x, log_weights, sent, members, options, turn), sent, x, log_weights);
}

/// What an exchange sends: to each neighbour one message of M particles, state and weight.
template <class R>
Traffic exchanged(const GroupOptions& options, std::size_t dimensions) {
  const auto messages = static_cast<double>(options.groups * degree(options.topology, options.groups));
  const auto particle = static_cast<double>(dimensions * sizeof(R) + sizeof(double));
  return {messages, messages * static_cast<double>(options.exchange_count) * particle};
}

}  // namespace mote
