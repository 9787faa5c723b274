#pragma once
/// The arithmetic of a mixed-mode design: what circuits, currents and converters make of a graph's operations.

#include <vector>

#include "mote/analog/placement.hpp"
#include "mote/graph/evaluate.hpp"

namespace mote::analog {

/// Computes the operations of a placement.
///
/// Method-1 divides y by x in double, the smaller by the larger, and hands circuits what a DAC makes of it; what
/// crosses into a sum with an arctangent is an angle, wrapped into [-pi, pi). Method-2 and 3 divide by a circuit that
/// is good up to |y/x| = 10. The rest of the plane comes by switched currents: arctan(q) = +-pi/2 - arctan(1/q), and
/// +-pi for x < 0.
///
/// cost    about 5 ns a circuit, as much for its noise
class MixedArithmetic {
 public:
  MixedArithmetic(const Placement& placement, const Design& design);

  /// Where noise comes from: a particle's draws; nullptr: there is none.
  void draw_from(Draw<double>* draw) { draw_ = draw; }

  double number(graph::Id id, double value) const {
    return parts_[id] == Part::kSource ? gains_[id] * std::clamp(value, -clip_, clip_) : value;
  }
  /// Whether an operation is that of the graph: digital, or currents that neither cross nor are scaled.
  bool is_exact(graph::Id id) const {
    return parts_[id] == Part::kDigital || parts_[id] == Part::kMemory ||
           (parts_[id] == Part::kCurrents && crossings_[id] == 0 && gains_[id] == 1);
  }
  /// An operation that is not exact.
  double compute(graph::Id id, const graph::Vertex& vertex, const std::array<double, 4>& operands);

  /// The angle that the circuit gives for a direction, without noise: its measured transfer.
  double transferred(double angle_rad) const;

 private:
  double arctan(double y, double x, double gain, bool noisy) const;
  double circuit(const Behaviour& behaviour, double x, bool noisy) const;
  double crossing(graph::Id id, double value);
  double digitised(graph::Id id, const Converter& adc, double value) const;
  double normal() const { return draw_ == nullptr ? 0 : draw_->normal(); }
  double normal_for(const Converter& converter) const { return converter.noisy() ? normal() : 0; }
  double gaussian(graph::Id id, double x);
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
  Draw<double>* draw_ = nullptr;
  graph::Id last_crossed_ = 0;  ///< where a row's measurement crossed last, the same for all particles
  double last_crossing_ = kNaN, last_crossed_value_ = 0;
};

}  // namespace mote::analog
