#pragma once
/// Vertices of a plan as operators of a sketch.

#include <map>
#include <memory>

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

/// Puts vertices into a sketch. Inputs are given first; results round to nearest and saturate.
class Mapping {
 public:
  Mapping(const Plan& plan, const graph::Recorded& recorded, const Precision& precision,
          const std::map<graph::Id, Fused>& fused, Sketch& sketch, Functions& functions)
      : plan_(plan),
        recorded_(recorded),
        precision_(precision),
        fused_(fused),
        sketch_(sketch),
        functions_(functions) {}

  /// What an input or a field is; it is converted to the vertex's format.
  void give(graph::Id id, const Signal& signal);
  /// Adds what outputs need.
  ///
  /// error   Refusal (kWrongUse) naming a vertex that no circuit exists for
  void compute(const std::vector<graph::Id>& outputs);
  /// A vertex in a format.
  Signal in(graph::Id id, const Format& format);

 private:
  Signal signal(graph::Id id) const { return signals_.at(id); }
  Signal made(graph::Id id);
  Signal sum(const graph::Vertex& v, const Format& y, bool subtract);
  Signal product(const graph::Vertex& v, const Format& y);
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
  [[noreturn]] void refuse(graph::Id id) const;

  const Plan& plan_;
  const graph::Recorded& recorded_;
  const Precision& precision_;
  const std::map<graph::Id, Fused>& fused_;
  Sketch& sketch_;
  Functions& functions_;
  std::map<graph::Id, Signal> signals_;
  std::map<std::string, Pair> pairs_;
};

}  // namespace mote::hardware
