#pragma once
/// The law of every operator: its circuit and its golden twin agree, bit for bit.

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mote/base/draws.hpp"
#include "mote/hardware/bench.hpp"

namespace mote::hardware {

/// Operators of any kinds, to be simulated in one design.
class Lockstep {
 public:
  template <Operator O>
  void add(const O& op) {
    circuits_.push_back(op.circuit());
    twins_.push_back([op](const Table& inputs, std::size_t rows) { return computed(op, inputs, rows); });
  }

  /// claim   for every row of random words, and for every pair of corners, circuit and twin give the same words
  /// twin    a circuit that is told to give another latency is caught (see bench_test.cpp)
  void expect_agreement(std::size_t rows, std::uint64_t seed = 1) const {
    std::vector<Table> inputs;
    for (const Circuit& circuit : circuits_) inputs.push_back(stimuli(circuit, rows, seed++));
    Bench bench(circuits_);
    const std::vector<Table> answers = bench.run(inputs, rows);
    for (std::size_t c = 0; c < circuits_.size(); ++c) expect_same(c, inputs[c], answers[c], rows);
  }

 private:
  /// The words where circuits break: the ends of the range, the middle and their neighbours.
  static std::vector<Word> corners(const Port& port) {
    const Word top = (Word{1} << (port.width - (port.sign ? 1 : 0))) - 1;
    if (port.sign) return {0, -1, 1, top, -top - 1, top - 1, -top, top / 2, -(top / 2)};
    return {0, 1, top, top - 1, top / 2, top / 2 + 1};
  }

  /// All pairs of corners first, then random words; half of them of random magnitude, so that small ones come too.
  static Table stimuli(const Circuit& circuit, std::size_t rows, std::uint64_t seed) {
    Table table;
    Xoshiro bits = keyed_generator({seed, 0, Purpose::kTest, 0}, 0);
    std::size_t period = 1;
    for (const Port& port : circuit.inputs) {
      const std::vector<Word> ends = corners(port);
      std::vector<Word>& column = table.emplace_back(rows);
      for (std::size_t row = 0; row < rows; ++row) {
        const std::uint64_t word = bits.next();
        const std::uint64_t size = bits.next();
        const int drop = 64 - port.width +
                         ((size & 1U) != 0 ? static_cast<int>((size >> 1U) % static_cast<unsigned>(port.width)) : 0);
        column[row] = row < 100   ? ends[row / period % ends.size()]
                      : port.sign ? static_cast<Word>(word) >> drop
                                  : static_cast<Word>(word >> drop);
      }
      period *= ends.size();
    }
    return table;
  }

  void expect_same(std::size_t c, const Table& inputs, const Table& answers, std::size_t rows) const {
    const Table expected = twins_[c](inputs, rows);
    ASSERT_EQ(expected.size(), answers.size());
    for (std::size_t p = 0; p < expected.size(); ++p) {
      std::size_t row = 0;
      while (row < rows && expected[p][row] == answers[p][row]) ++row;
      if (row == rows) continue;
      std::string given;
      for (const auto& column : inputs) given += " " + std::to_string(column[row]);
      ADD_FAILURE() << "circuit " << c << " (" << circuits_[c].module << "), output " << p << ", row " << row << ":"
                    << given << ": the twin gives " << expected[p][row] << ", the circuit " << answers[p][row];
    }
  }

  std::vector<Circuit> circuits_;
  std::vector<std::function<Table(const Table&, std::size_t)>> twins_;
};

}  // namespace mote::hardware
