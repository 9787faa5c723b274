#pragma once
/// Programs: functions of a graph in the order in which they are computed, for any number type and for blocks.

#include <vector>

#include "mote/graph/evaluate.hpp"
#include "mote/model/model.hpp"

namespace mote::graph {

/// How often a value changes.
enum class Varies : std::uint8_t {
  kNever,     ///< a constant
  kStep,      ///< with t
  kRow,       ///< with the data's row
  kParticle,  ///< with the state or a draw
};

/// Where the inputs of a program are read; what it does not read may be left out.
template <class S>
struct Sources {
  const S* state = nullptr;     ///< (D,), kState
  const S* before = nullptr;    ///< (D,), kBefore
  const Row<S>* row = nullptr;  ///< kColumn
  const S* draws = nullptr;     ///< by number
};

/// What a block computes particle by particle: the values that vary between particles, without the others.
///
/// Slots are numbered: first the uniform values, then the state's components, the draws, the outputs, and registers
/// that are used again once their value has been read for the last time.
struct BlockCode {
  /// Two operations in one: the product a b and what is done with it.
  enum class Fused : std::uint8_t {
    kNone,
    kPlus,   ///< a b + c
    kMinus,  ///< a b - c
    kFrom,   ///< c - a b
    kCopy,   ///< a
  };
  struct Instruction {
    Op op;
    Fused fused;
    std::uint16_t out;
    std::array<std::uint16_t, 4> args;
  };

  std::vector<std::uint32_t> uniforms;  ///< the program's values that are read as uniform ones
  std::size_t states = 0, draws = 0;    ///< the first of them, up to the last one that is read
  std::size_t outputs = 0, registers = 0;
  std::vector<Instruction> code;

  std::size_t first_state() const { return uniforms.size(); }
  std::size_t first_draw() const { return first_state() + states; }
  std::size_t first_output() const { return first_draw() + draws; }
  std::size_t first_register() const { return first_output() + outputs; }
  std::size_t slots() const { return first_register() + registers; }
};

/// Some vertices of a graph and all that they depend on.
class Program {
 public:
  Program() = default;
  Program(const Graph& graph, std::span<const Id> outputs);

  /// Computes the outputs: in double what follows from t alone, the rest in S.
  ///
  /// shape   out: as many as outputs
  /// cost    O(vertices)
  template <class S>
  void run(Step t, const Sources<S>& sources, S* out) const {
    std::vector<S> values(code_.size());
    std::vector<double> known(code_.size());
    fill(t, sources, Varies::kParticle, known, values);
    for (std::size_t k = 0; k < outputs_.size(); ++k) out[k] = values[outputs_[k]];
  }

  /// Computes what is the same for all particles, as run() does.
  ///
  /// shape   values: (size(),)
  template <class S>
  void fill_uniform(Step t, const Row<S>* row, std::vector<double>& known, std::vector<S>& values) const {
    known.resize(code_.size());
    values.resize(code_.size());
    fill(t, Sources<S>{.row = row}, Varies::kRow, known, values);
  }

  std::size_t size() const { return code_.size(); }
  Varies varies(std::size_t value) const { return varies_[value]; }
  const BlockCode& block_code() const { return block_; }

 private:
  template <class S>
  void fill(Step t, const Sources<S>& sources, Varies up_to, std::vector<double>& known, std::vector<S>& values) const {
    for (std::size_t i = 0; i < code_.size(); ++i) {
      const Vertex& v = code_[i];
      if (varies_[i] > up_to) continue;
      if (varies_[i] <= Varies::kStep) {
        known[i] = v.op == Op::kConstant ? v.value
                   : v.op == Op::kInput  ? static_cast<double>(t)
                                         : apply<double>(v.op, operands(v, known));
        if constexpr (requires { S::following_t(known[i], marks_[i]); })
          values[i] = S::following_t(known[i], marks_[i]);
        else
          values[i] = S(known[i]);
      } else {
        values[i] = v.op == Op::kInput ? read(v, sources) : apply<S>(v.op, operands(v, values));
      }
    }
  }
  template <class S>
  static std::array<S, 4> operands(const Vertex& v, const std::vector<S>& values) {
    std::array<S, 4> args{};
    for (std::size_t k = 0; k < arity(v.op); ++k) args[k] = values[v.args[k]];
    return args;
  }
  template <class S>
  static S read(const Vertex& v, const Sources<S>& sources) {
    if (v.role == Role::kState) return sources.state[v.index];
    if (v.role == Role::kBefore) return sources.before[v.index];
    if (v.role == Role::kColumn) return (*sources.row)[v.index];
    return sources.draws[v.index];
  }

  std::vector<Vertex> code_;  ///< operands are numbers of values here
  std::vector<Varies> varies_;
  std::vector<std::uint64_t> marks_;  ///< how what varies with the step follows t
  std::vector<std::uint32_t> outputs_;
  BlockCode block_;
};

}  // namespace mote::graph
