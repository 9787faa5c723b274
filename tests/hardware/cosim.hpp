#pragma once
/// Circuits of datapaths against their golden twins.

#include <gtest/gtest.h>

#include "mote/hardware/bench.hpp"
#include "tests/hardware/models.hpp"

namespace mote::hardware {

/// A row a particle: random words of random size on every port, those that stand still the same in all rows.
inline Table stimuli(const Circuit& circuit, std::size_t rows, Xoshiro& bits) {
  Table table;
  for (const Port& port : circuit.inputs) {
    const auto word = [&] {
      const std::uint64_t value = bits.next();
      const std::uint64_t size = bits.next();
      const int drop =
          64 - port.width + ((size & 1U) != 0 ? static_cast<int>((size >> 1U) % static_cast<unsigned>(port.width)) : 0);
      return port.sign ? static_cast<Word>(value) >> drop : static_cast<Word>(value >> drop);
    };
    std::vector<Word>& column = table.emplace_back(rows);
    if (port.name == "first_i" || port.name.starts_with("obs"))
      column.assign(rows, word());
    else
      std::generate(column.begin(), column.end(), word);
  }
  return table;
}

/// claim    propose and weigh give their golden twins' words, row by row; says how many words were compared
/// design   all circuits in one Verilated design, lint clean; `steps` observations with `rows` particles each, of which
///          those of the first 300 clocks, when the observation changes, are left out
inline std::size_t expect_equal_to_circuits(const std::vector<Subject>& subjects, std::size_t steps, std::size_t rows) {
  constexpr std::size_t kSettling = 300;
  std::vector<const Compound*> twins;
  std::vector<Circuit> circuits;
  for (const Subject& subject : subjects)
    for (const Compound* twin : {&subject.datapath.propose, &subject.datapath.weigh}) {
      twins.push_back(twin);
      circuits.push_back(twin->circuit());
    }
  Bench bench(circuits);
  Xoshiro bits = keyed_generator({1, 0, Purpose::kTest, 0}, 0);
  std::size_t compared = 0;
  for (std::size_t step = 0; step < steps; ++step) {
    std::vector<Table> inputs;
    for (const Circuit& circuit : circuits) inputs.push_back(stimuli(circuit, rows + kSettling, bits));
    const std::vector<Table> answers = bench.run(inputs, rows + kSettling);
    for (std::size_t c = 0; c < circuits.size(); ++c) {
      const Table expected = computed(*twins[c], inputs[c], rows + kSettling);
      for (std::size_t p = 0; p < expected.size(); ++p) {
        const auto from = static_cast<std::ptrdiff_t>(kSettling);
        EXPECT_TRUE(std::equal(expected[p].begin() + from, expected[p].end(), answers[c][p].begin() + from))
            << circuits[c].module << ", output " << p << ", observation " << step;
        compared += rows;
      }
    }
  }
  return compared;
}

}  // namespace mote::hardware
