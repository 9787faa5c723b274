#pragma once
/// The arithmetic of a mixed-mode design: what circuits, currents and converters make of a graph's operations.

#include <vector>

#include "mote/analog/placement.hpp"
#include "mote/base/tile_draws.hpp"
#include "mote/graph/evaluate.hpp"

namespace mote::analog {

/// Where operands stand, each a column of particles.
using Columns = std::array<const double*, 4>;

/// Normal numbers for noise: number k of particle i; no numbers, no noise.
struct Normals {
  const double* numbers = nullptr;
  std::size_t stride = 0;

  double operator()(std::size_t k, std::size_t i) const { return numbers == nullptr ? 0 : numbers[k * stride + i]; }
};

/// Computes the operations of a placement.
///
/// Method-1 divides y by x in double, the smaller by the larger, and hands circuits what a DAC makes of it; what
/// crosses into a sum with an arctangent is an angle, wrapped into [-pi, pi). Method-2 and 3 divide by a circuit that
/// is good up to |y/x| = 10. The rest of the plane comes by switched currents: arctan(q) = +-pi/2 - arctan(1/q), and
/// +-pi for x < 0.
///
/// cost    some nanoseconds a circuit and particle, as much for a normal number of its noise
class MixedArithmetic {
 public:
  MixedArithmetic(const Placement& placement, const Design& design);

  /// What graph::Replayed asks of an arithmetic: one particle by itself, which has no noise.
  using Number = double;
  double number(graph::Id id, double value) const {
    source(id, &value, 1);
    return value;
  }
  static double value(graph::Id, double number) { return number; }
  double compute(graph::Id id, const graph::Vertex& vertex, const std::array<double, 4>& operands) {
    double out = 0;
    compute(id, vertex, {&operands[0], &operands[1], &operands[2], &operands[3]}, {}, 1, &out);
    return out;
  }

  /// Makes of an input's values what its part makes of them.
  void source(graph::Id id, double* values, std::size_t count) const {
    if (parts_[id] != Part::kSource) return;
    for (std::size_t i = 0; i < count; ++i) values[i] = gains_[id] * std::clamp(values[i], -clip_, clip_);
  }
  /// How many normal numbers an operation takes as noise.
  std::size_t normals(graph::Id id) const;
  /// An operation on `count` particles, at most kTile.
  void compute(graph::Id id, const graph::Vertex& vertex, const Columns& operands, const Normals& noise,
               std::size_t count, double* out);

  /// The angle that the circuit gives for a direction, without noise: its measured transfer.
  double transferred(double angle_rad) const;

 private:
  /// arctan(y/x) all around, by a circuit for a quotient.
  template <class Circuit>
  double in_the_plane(double y, double x, const Circuit& circuit) const {
    const double most = method_ == Method::kWeights ? 1 : kRange;
    const bool steep = std::abs(y) > most * std::abs(x);
    const double below = steep ? y : x;
    const double angle = circuit(below == 0 ? 0 : divider_gain_ * (steep ? x : y) / below);
    if (steep) return (y > 0 ? kPi / 2 : -kPi / 2) - angle;
    return x < 0 ? angle + (y < 0 ? -kPi : kPi) : angle;
  }
  void arctans(graph::Id id, const graph::Vertex& vertex, const Columns& operands, const Normals& noise,
               std::size_t count, double* out) const;
  void gaussians(graph::Id id, const double* x, const Normals& noise, std::size_t count, double* out) const;
  double crossing(graph::Id id, double value, double normal);
  void choose_gains(const Placement& placement, const Design& design);

  std::vector<Part> parts_;
  std::vector<std::uint8_t> crossings_;
  std::vector<bool> against_arctan_, to_digital_;
  std::vector<double> gains_;   ///< by vertex
  std::vector<double> widths_;  ///< by vertex, of Gaussians: by what their input is divided
  Method method_;
  Calibration calibration_;
  std::optional<Behaviour> arctan_, gaussian_;
  double clip_, comparator_noise_, divider_gain_ = 1;
  Converter quotient_dac_, angle_dac_, input_dac_, angle_adc_, weight_adc_;
  graph::Id last_crossed_ = 0;  ///< where a row's measurement crossed last, the same for all particles
  double last_crossing_ = kNaN, last_crossed_value_ = 0;
};

}  // namespace mote::analog
