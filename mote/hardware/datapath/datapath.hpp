#pragma once
/// From a recorded model to the two pipelines that a filter in hardware asks for, with their golden twins.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mote/graph/record.hpp"
#include "mote/hardware/compound.hpp"
#include "mote/hardware/datapath/samples.hpp"
#include "mote/hardware/filters/arithmetic.hpp"
#include "mote/hardware/functions.hpp"

namespace mote::hardware {

/// What a datapath may be told.
struct DatapathOptions {
  Multiplier multiplier = Multiplier::kDsp;
  Form form = Form::kTable;
  double margin = 0.25;               ///< by which ranges are wider than the samples
  int more_bits = 0;                  ///< after the point, for all words
  bool fuse = true;                   ///< functions of one number become one table where that is smaller
  bool overlapped = false;            ///< observations go with each particle instead of standing
  int interval = 1;                   ///< clocks from a particle to the next, in which costly operators take turns
  bool logic_tables = false;          ///< tables of all values in look-up tables instead of blocks of memory
  std::string prefix = "mote_model";  ///< of the modules' names: <prefix>_propose and <prefix>_weigh
};

/// A number that comes with a step: a column of its row, a number of the schedule, another number that the host
/// computes from them, or a bit "the columns were seen".
struct ObservedField {
  std::string name;  ///< "y", "schedule 0", "v12", "y seen"
  Format format;
  int at = 0;  ///< its first bit in the observation word
};

/// A model as a circuit.
///
/// propose: parents and words to states; weigh: states to log2 p(y | x) without the terms that do not depend on the
/// state, s13.10, saturated. At t = 1 the parent's state is drawn by `initial`, then moved by `next` as later ones are;
/// the draws of both are parts of the same words (draws.hpp). An observation that was not seen adds nothing; a term of
/// the likelihood that reads several counts when all of them were seen. With a recorded proposal a state goes with its
/// parent, before0_o .., to be weighed: formats.carried. Every input of a pipeline but the observation
/// word and first_i belongs to one particle; those two must stand from 3 clocks before the first particle of a step
/// until its last has left, or belong to one particle too (overlapped).
struct Datapath {
  Compound propose{"propose"}, weigh{"weigh"};
  Arithmetic arithmetic;                ///< formats and golden twins; `observed` has the fields in order
  std::vector<Format> states;           ///< binary points by state, all of formats.value_bits bits
  std::vector<std::string> names;       ///< of these states: the model's, then those of directions (directions.hpp)
  std::vector<std::uint32_t> turning;   ///< states of the model that have directions, in their order
  std::vector<ObservedField> observed;  ///< the observation word, from bit 0 on
  int observed_bits = 0;                ///< of the whole word
  double constant = 0;                  ///< octaves: what log2 p(y | x) of a whole row has more
  std::function<std::vector<std::int64_t>(const Row<double>&, const std::vector<double>&)> host;  ///< see observe()

  /// The fields of a step as integers; values that were not seen are 0.
  ///
  /// shape   row: as the model's columns; schedule: recorded.schedule(t)
  std::vector<std::int64_t> observe(const Row<double>& row, const std::vector<double>& schedule) const;
  /// The means of the model's states by the words that a circuit gave; of an angle with a direction, the direction's.
  std::vector<double> means(const std::vector<std::int64_t>& words) const;
};

/// What the ports of a pipeline are connected to, clk_i first.
using Connections = std::vector<std::pair<std::string, std::string>>;

/// Connections of the pipelines to buses of mote_imh and mote_sisr by these names: t, obs, parent, words, proposed;
/// weigh_obs, to_weigh, log_weight; and, where
/// operators take turns, to propose_valid and weigh_valid.
Connections propose_connections(const Datapath& datapath);
Connections weigh_connections(const Datapath& datapath);

/// A model's datapath. Words are as short as the samples allow (precision.hpp).
///
/// cost    a second: tables are fitted
Datapath datapath(const graph::Recorded& recorded, const Samples& samples, const DatapathOptions& options = {});

}  // namespace mote::hardware
