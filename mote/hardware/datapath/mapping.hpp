#pragma once
/// Vertices of a plan as operators of a sketch.

#include <map>
#include <memory>
#include <optional>

#include "mote/hardware/datapath/fusion.hpp"
#include "mote/hardware/datapath/plan.hpp"
#include "mote/hardware/datapath/precision.hpp"
#include "mote/hardware/function_parts.hpp"
#include "mote/hardware/sketch.hpp"

namespace mote::hardware {

/// Functions that were made: equal ones share their tables' fits.
class Functions {
 public:
  explicit Functions(const FunctionOptions& options) : options_(options) {}

  const FunctionOptions& options() const { return options_; }
  /// The compound of that key, made once.
  template <class Make>
  const Compound& once(const std::string& key, Make make) {
    const auto found = compounds_.find(key);
    return found != compounds_.end() ? found->second : compounds_.emplace(key, make()).first->second;
  }

 private:
  FunctionOptions options_;
  std::map<std::string, Compound> compounds_;
};

/// Puts vertices into a sketch. Inputs are given first; results round to nearest and saturate. A sum of sums is one
/// sum: its terms are added as they come.
class Mapping {
 public:
  /// overlapped: fields go with each particle instead of standing.
  Mapping(const Plan& plan, const Precision& precision, const std::map<graph::Id, Fused>& fused, Sketch& sketch,
          Functions& functions, bool overlapped)
      : plan_(plan),
        precision_(precision),
        fused_(fused),
        sketch_(sketch),
        functions_(functions),
        overlapped_(overlapped),
        readers_(readers_of(plan)),
        room_(room_of(plan, fused)) {}

  /// What an input or a field is; it is converted to the vertex's format.
  void give(graph::Id id, const Signal& signal);
  /// Adds what outputs need.
  void compute(const std::vector<graph::Id>& outputs);
  /// A vertex in a format.
  Signal in(graph::Id id, const Format& format);

 private:
  /// A term of a sum.
  struct Term {
    graph::Id id;
    bool negative;
  };

  Signal signal(graph::Id id) const { return signals_.at(id); }
  bool within_sum(graph::Id id) const;
  std::vector<Term> terms(graph::Id sum) const;
  std::vector<graph::Id> operands(graph::Id id) const;
  Signal made(graph::Id id);
  Signal tabulated(graph::Id id);
  std::optional<graph::Id> partner_of(graph::Id id) const;
  Signal sum(graph::Id id);
  Signal product(graph::Id id);
  Signal by_constant(const Signal& a, graph::Id constant, const Format& y);
  Signal selection(const graph::Vertex& v, const Format& y);
  Signal function(graph::Id id, const Format& y);
  Signal unary(const std::string& name, const Signal& x, const Format& y,
               Compound (*make)(const Format&, const Format&, const FunctionOptions&));
  Signal cosine_or_sine(const graph::Vertex& v, const Format& y);
  Signal angle(const graph::Vertex& v, const Format& y);
  Signal operand(graph::Id id);
  Signal unsigned_of(const Signal& a);
  Signal converted(const Signal& a, const Format& y) { return a.format == y ? a : sketch_.convert(a, y); }
  Format roomy(graph::Id id, int integer, int fraction, int more) const;
  static std::vector<unsigned> readers_of(const Plan& plan);
  static std::vector<int> room_of(const Plan& plan, const std::map<graph::Id, Fused>& fused);

  const Plan& plan_;
  const Precision& precision_;
  const std::map<graph::Id, Fused>& fused_;
  Sketch& sketch_;
  Functions& functions_;
  bool overlapped_;
  std::vector<unsigned> readers_;  ///< by vertex: how often others and results read it
  std::vector<int> room_;          ///< by vertex: the bits that it may grow to where that is cheaper
  std::vector<bool> wanted_;       ///< by vertex: to be computed
  std::map<graph::Id, Signal> signals_;
  std::map<std::string, Pair> pairs_;
};

}  // namespace mote::hardware
