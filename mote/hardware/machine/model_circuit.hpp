#pragma once
/// A model as a filter circuit takes it in: its two pipelines, their golden functions, and what their bits mean.

#include <string>
#include <utility>
#include <vector>

#include "mote/hardware/circuit.hpp"
#include "mote/hardware/filters/arithmetic.hpp"

namespace mote::hardware {

/// A number of the model where it goes over a bus.
struct Field {
  std::string name;
  Format format;
};

/// The pipelines and their golden functions.
///
/// Connections lead to the buses of mote_imh and mote_sisr by these names: t, obs, parent, words, proposed of propose;
/// weigh_obs, to_weigh, log_weight of weigh; and, where operators take turns, propose_valid and weigh_valid.
struct ModelCircuit {
  using Connections = std::vector<std::pair<std::string, std::string>>;

  std::string name;  ///< an identifier
  Circuit propose, weigh;
  Connections propose_connections, weigh_connections;
  std::vector<Field> states;    ///< words of arithmetic.formats.value_bits, each with its own point
  std::vector<Field> observed;  ///< of the observation word, from bit 0 on
  Arithmetic arithmetic;

  int observed_bits() const {
    int bits = 0;
    for (const Field& field : observed) bits += field.format.width();
    return bits;
  }
};

}  // namespace mote::hardware
