#pragma once
/// Placement: which vertices of a model's graph are analog circuits, and where values cross from digital to analog.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mote/analog/method.hpp"
#include "mote/graph/record.hpp"

namespace mote::analog {

/// What computes a vertex.
enum class Part : std::uint8_t {
  kDigital,   ///< exact
  kCurrents,  ///< analog sums and scalings between two circuits: exact but for the gains of Method-2 and 3
  kArctan,    ///< of atan or atan2
  kGaussian,  ///< exp(-x^2/2) of its operand
  kSquare,    ///< -x^2/2 of its operand, in the log domain
  kSource,    ///< a normal number of the model
  kMemory,    ///< what keeps x_{t-1}: exact but for the error that it draws itself
};

/// A recording with its analog vertices found and marked.
///
/// The Gaussian of a log likelihood is where a square stands: each term c e^2, c < 0, becomes
/// log gaussian(sqrt(-2 c) e); where the model says exp(c e^2) itself, gaussian(sqrt(-2 c) e).
struct Placement {
  graph::Recorded recorded;
  std::vector<Part> parts;              ///< by vertex
  std::vector<std::uint8_t> crossings;  ///< by vertex: bit k, operand k comes from the digital side
  std::vector<bool> against_arctan;     ///< by vertex: a crossing there is subtracted from an arctangent, or it from it
  std::vector<bool> to_digital;         ///< by vertex: a circuit whose output goes through an ADC
  std::vector<bool> behind_arctan;      ///< by vertex: a Gaussian or square whose operand follows an arctangent
  std::size_t arctans = 0, gaussians = 0;
};

/// One over sigma of a Gaussian or square: by which constant its operand is a multiple of a residual.
std::optional<double> inverse_sigma(const Placement& placement, graph::Id id);

/// Which functions are analog.
struct Wanted {
  bool arctan = true, gaussian = true;
};

/// The placement of a method. With kWeights the analog vertices are those of the likelihood; with the others those of
/// the move, too, and x_{t-1} comes from analog memory, which takes a draw for each component.
///
/// error   none: counts say what was found
/// cost    O(vertices)
Placement placed(const graph::Recorded& recorded, Method method, Wanted wanted, const Cells& cells);

/// The circuits that a model has use for by a method: a move's arctangent is analog with some; kAllButRandom has no
/// Gaussian.
Wanted functions_of(const graph::Recorded& recorded, Method method);

}  // namespace mote::analog
