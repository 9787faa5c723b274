#pragma once
/// The block-vector interpreter: every operation of a program in a loop over many particles, so that choosing the
/// operation costs little.

#include "mote/base/aligned.hpp"
#include "mote/base/draws.hpp"
#include "mote/graph/program.hpp"

namespace mote::graph {

/// Runs a program over blocks of particles in vectors V of numbers R; V has load, store and the arithmetic of a model's
/// number type, and fma(a, b, c) = a b + c, fnma(a, b, c) = c - a b.
///
/// shape   columns filled up to whole vectors: the last one is computed whole
/// error   none; results are those of run() in V, products rounded together with their sums
/// cost    about two cycles an operation and vector; (registers + uniform values) of scratch
template <class V>
class Interpreter {
 public:
  using R = typename V::Number;

  explicit Interpreter(const Program& program)
      : program_(&program),
        block_(&program.block_code()),
        uniforms_(block_->uniforms.size() * V::kLanes),
        registers_(block_->registers * kTile),
        places_(block_->slots()) {
    for (std::size_t k = 0; k < block_->uniforms.size(); ++k)
      places_[k] = {uniforms_.data() + k * V::kLanes, nullptr, 0, 0};
    for (std::size_t k = 0; k < block_->registers; ++k)
      places_[block_->first_register() + k] = both(registers_.data() + k * kTile, 0);
  }

  /// Computes the outputs of `count` particles at step t, from particle `first` on.
  ///
  /// shape   states[d][first + i]; draws[k kBlock + i]; outputs[k][first + i]
  void run(Step t, const Row<V>* row, const R* const* states, const R* draws, R* const* outputs, std::size_t first,
           std::size_t count) {
    program_->fill_uniform(t, row, known_, values_);
    for (std::size_t k = 0; k < block_->uniforms.size(); ++k)
      values_[block_->uniforms[k]].store(uniforms_.data() + k * V::kLanes);
    for (std::size_t d = 0; d < block_->states; ++d)
      places_[block_->first_state() + d] = {states[d] + first, nullptr, 1, V::kLanes};
    for (std::size_t k = 0; k < block_->draws; ++k)
      places_[block_->first_draw() + k] = {draws + k * kBlock, nullptr, 1, V::kLanes};
    for (std::size_t k = 0; k < block_->outputs; ++k) places_[block_->first_output() + k] = both(outputs[k] + first, 1);
    for (std::size_t start = 0; start < count; start += kTile)
      tile(start, (std::min(kTile, count - start) + V::kLanes - 1) / V::kLanes);
  }

 private:
  /// Particles that are taken through the whole program at a time: registers stay in the first-level cache.
  static constexpr std::size_t kTile = 256;

  /// Where a slot is read, and written if it is, how far it moves with the tile, and with the vector.
  struct Place {
    const R* from;
    R* to;
    std::size_t moves, step;
  };
  static Place both(R* numbers, std::size_t moves) { return {numbers, numbers, moves, V::kLanes}; }
  struct Operand {
    const R* numbers;
    std::size_t step;
    V operator()(std::size_t k) const { return V::load(numbers + k * step); }
  };

  [[gnu::flatten, gnu::noinline]] void tile(std::size_t start, std::size_t vectors) const {
    for (const BlockCode::Instruction& i : block_->code) {
      const auto operand = [&](std::size_t k) {
        const Place& place = places_[i.args[k]];
        return Operand{place.from + place.moves * start, place.step};
      };
      const Place& out = places_[i.out];
      R* const to = out.to + out.moves * start;
      const auto each = [&](const auto& f) {
        for (std::size_t k = 0; k < vectors; ++k) f(k).store(to + k * V::kLanes);
      };
      const Operand a = operand(0);
      const Operand b = operand(1);
      const Operand c = operand(2);
      using Fused = BlockCode::Fused;
      if (i.fused == Fused::kPlus) {
        each([&](std::size_t k) { return fma(a(k), b(k), c(k)); });
      } else if (i.fused == Fused::kMinus) {
        each([&](std::size_t k) { return fma(a(k), b(k), -c(k)); });
      } else if (i.fused == Fused::kFrom) {
        each([&](std::size_t k) { return fnma(a(k), b(k), c(k)); });
      } else if (i.fused == Fused::kCopy) {
        each([&](std::size_t k) { return a(k); });
      } else {
        compute(i.op, a, b, c, operand(3), each);
      }
    }
  }

  template <class Each>
  static void compute(Op op, const Operand& a, const Operand& b, const Operand& c, const Operand& d, const Each& each) {
    switch (op) {
      case Op::kAdd:
        return each([&](std::size_t k) { return a(k) + b(k); });
      case Op::kSubtract:
        return each([&](std::size_t k) { return a(k) - b(k); });
      case Op::kMultiply:
        return each([&](std::size_t k) { return a(k) * b(k); });
      case Op::kDivide:
        return each([&](std::size_t k) { return a(k) / b(k); });
      case Op::kNegate:
        return each([&](std::size_t k) { return -a(k); });
      case Op::kAbs:
        return each([&](std::size_t k) { return abs(a(k)); });
      case Op::kFloor:
        return each([&](std::size_t k) { return floor(a(k)); });
      case Op::kSqrt:
        return each([&](std::size_t k) { return sqrt(a(k)); });
      case Op::kExp:
        return each([&](std::size_t k) { return exp(a(k)); });
      case Op::kLog:
        return each([&](std::size_t k) { return log(a(k)); });
      case Op::kSin:
        return each([&](std::size_t k) { return sin(a(k)); });
      case Op::kCos:
        return each([&](std::size_t k) { return cos(a(k)); });
      case Op::kTan:
        return each([&](std::size_t k) { return tan(a(k)); });
      case Op::kAtan:
        return each([&](std::size_t k) { return atan(a(k)); });
      case Op::kAtan2:
        return each([&](std::size_t k) { return atan2(a(k), b(k)); });
      case Op::kSelect:
        return each([&](std::size_t k) { return select(less(a(k), b(k)), c(k), d(k)); });
      case Op::kConstant:
      case Op::kInput:
        break;
    }
  }

  const Program* program_;
  const BlockCode* block_;
  AlignedVector<R> uniforms_, registers_;
  std::vector<Place> places_;
  std::vector<double> known_;
  std::vector<V> values_;
};

}  // namespace mote::graph
