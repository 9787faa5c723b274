#include "mote/graph/program.hpp"

#include <algorithm>
#include <optional>

namespace mote::graph {
namespace {

Varies varies_of(const Vertex& v) {
  if (v.op == Op::kConstant) return Varies::kNever;
  if (v.role == Role::kTime) return Varies::kStep;
  return v.role == Role::kColumn ? Varies::kRow : Varies::kParticle;
}

bool is_state(const Vertex& v) { return v.role == Role::kState || v.role == Role::kBefore; }

/// Turns a program's values into code for blocks.
class BlockCompiler {
 public:
  using Instruction = BlockCode::Instruction;
  using Fused = BlockCode::Fused;

  BlockCompiler(const std::vector<Vertex>& code, const std::vector<Varies>& varies,
                const std::vector<std::uint32_t>& outputs)
      : code_(code),
        varies_(varies),
        outputs_(outputs),
        slot_(code.size()),
        last_use_(code.size()),
        uses_(code.size()) {
    block_.outputs = outputs.size();
    for (const Vertex& v : code)
      if (v.op == Op::kInput && varies_of(v) == Varies::kParticle)
        (is_state(v) ? block_.states : block_.draws) =
            std::max<std::size_t>(is_state(v) ? block_.states : block_.draws, v.index + 1);
  }

  BlockCode compiled() {
    note_uses();
    choose_fusions();
    place_what_is_given();
    for (std::uint32_t i = 0; i < code_.size(); ++i)
      if (computed(i) && !swallowed_[i]) emit(i);
    for (std::uint32_t k = 0; k < outputs_.size(); ++k)
      if (*slot_[outputs_[k]] != output_slot(k))
        block_.code.push_back({Op::kAdd, Fused::kCopy, output_slot(k), {*slot_[outputs_[k]]}});
    return std::move(block_);
  }

 private:
  bool computed(std::uint32_t i) const { return varies_[i] == Varies::kParticle && code_[i].op != Op::kInput; }
  std::uint16_t output_slot(std::size_t k) const { return static_cast<std::uint16_t>(block_.first_output() + k); }

  /// Operands of an instruction after fusion: those of the product, then the other one.
  std::vector<std::uint32_t> reads(std::uint32_t i) const {
    const Vertex& v = code_[i];
    if (const auto product = product_in_[i]) {
      const Vertex& p = code_[*product];
      return {p.args[0], p.args[1], v.args[0] == *product ? v.args[1] : v.args[0]};
    }
    return {v.operands().begin(), v.operands().end()};
  }

  void note_uses() {
    for (const Vertex& v : code_)
      for (const Id arg : v.operands()) ++uses_[arg];
    for (const std::uint32_t output : outputs_) ++uses_[output];
  }

  /// A product that is read once, by a sum or difference, becomes part of it.
  void choose_fusions() {
    product_in_.resize(code_.size());
    swallowed_.resize(code_.size());
    for (std::uint32_t i = 0; i < code_.size(); ++i) {
      const Vertex& v = code_[i];
      if (!computed(i) || (v.op != Op::kAdd && v.op != Op::kSubtract)) continue;
      for (const Id arg : v.operands()) {
        if (product_in_[i] || uses_[arg] != 1 || code_[arg].op != Op::kMultiply || !computed(arg)) continue;
        product_in_[i] = arg;
        swallowed_[arg] = true;
      }
    }
    for (std::uint32_t i = 0; i < code_.size(); ++i)
      if (computed(i) && !swallowed_[i])
        for (const std::uint32_t arg : reads(i)) last_use_[arg] = i;
    for (const std::uint32_t output : outputs_) last_use_[output] = static_cast<std::uint32_t>(code_.size());
  }

  void place_what_is_given() {
    std::vector<bool> read(code_.size());
    for (std::uint32_t i = 0; i < code_.size(); ++i)
      if (computed(i) && !swallowed_[i])
        for (const std::uint32_t arg : reads(i)) read[arg] = true;
    for (const std::uint32_t output : outputs_) read[output] = true;
    for (std::uint32_t i = 0; i < code_.size(); ++i)
      if (read[i] && varies_[i] != Varies::kParticle) block_.uniforms.push_back(i);
    for (std::size_t k = 0; k < block_.uniforms.size(); ++k) slot_[block_.uniforms[k]] = static_cast<std::uint16_t>(k);
    for (std::uint32_t i = 0; i < code_.size(); ++i) {
      const Vertex& v = code_[i];
      if (v.op != Op::kInput || varies_[i] != Varies::kParticle) continue;
      slot_[i] = static_cast<std::uint16_t>((is_state(v) ? block_.first_state() : block_.first_draw()) + v.index);
    }
    for (std::size_t k = 0; k < outputs_.size(); ++k)
      if (computed(outputs_[k]) && !slot_[outputs_[k]]) slot_[outputs_[k]] = output_slot(k);
  }

  Fused fused(std::uint32_t i) const {
    if (!product_in_[i]) return Fused::kNone;
    if (code_[i].op == Op::kAdd) return Fused::kPlus;
    return code_[i].args[0] == *product_in_[i] ? Fused::kMinus : Fused::kFrom;
  }

  void emit(std::uint32_t i) {
    Instruction made{code_[i].op, fused(i), 0, {}};
    const auto args = reads(i);
    for (std::size_t k = 0; k < args.size(); ++k) made.args[k] = *slot_[args[k]];
    for (const std::uint32_t arg : args) release(arg, i);
    if (!slot_[i]) slot_[i] = fresh_register();
    made.out = *slot_[i];
    block_.code.push_back(made);
  }

  /// Frees the register of a value that is read for the last time.
  void release(std::uint32_t value, std::uint32_t now) {
    if (last_use_[value] != now || *slot_[value] < block_.first_register()) return;
    if (std::find(free_.begin(), free_.end(), *slot_[value]) == free_.end()) free_.push_back(*slot_[value]);
  }
  std::uint16_t fresh_register() {
    if (free_.empty()) return static_cast<std::uint16_t>(block_.first_register() + block_.registers++);
    const std::uint16_t slot = free_.back();
    free_.pop_back();
    return slot;
  }

  const std::vector<Vertex>& code_;
  const std::vector<Varies>& varies_;
  const std::vector<std::uint32_t>& outputs_;
  std::vector<std::optional<std::uint16_t>> slot_;
  std::vector<std::uint32_t> last_use_;  ///< the value whose instruction reads it last
  std::vector<std::uint32_t> uses_;
  std::vector<std::optional<std::uint32_t>> product_in_;  ///< the product that a sum has swallowed
  std::vector<bool> swallowed_;
  std::vector<std::uint16_t> free_;
  BlockCode block_;
};

}  // namespace

Program::Program(const Graph& graph, std::span<const Id> outputs) {
  const std::vector<bool> used = reached(graph, outputs);
  std::vector<std::uint32_t> number(graph.size());
  for (Id id = 0; id < graph.size(); ++id) {
    if (!used[id]) continue;
    number[id] = static_cast<std::uint32_t>(code_.size());
    Vertex v = graph[id];
    Varies varies = arity(v.op) == 0 ? varies_of(v) : Varies::kNever;
    std::array<double, 4> values{};
    std::array<std::uint64_t, 4> marks{};
    for (std::size_t k = 0; k < arity(v.op); ++k) {
      v.args[k] = number[v.args[k]];
      varies = std::max(varies, varies_[v.args[k]]);
      values[k] = code_[v.args[k]].value;
      marks[k] = marks_[v.args[k]];
    }
    marks_.push_back(varies == Varies::kStep && v.op == Op::kInput ? kMarkOfTime : mark_of(v.op, values, marks));
    code_.push_back(v);
    varies_.push_back(varies);
  }
  for (const Id id : outputs) outputs_.push_back(number[id]);
  block_ = BlockCompiler(code_, varies_, outputs_).compiled();
}

}  // namespace mote::graph
