#include "mote/analog/arithmetic.hpp"

#include "mote/analog/purposes.hpp"

namespace mote::analog {
namespace {

using graph::Id;
using graph::Op;
using graph::Vertex;

/// Inputs of a Gaussian that a DAC covers: exp(-4^2/2) is below half a step of 8 bits.
constexpr double kWidest = 4;

/// A product with a constant that is a current mirror; one with a whole number of turns is a switch.
bool is_mirror(const graph::Graph& graph, const Vertex& v) {
  if (v.op != Op::kMultiply) return false;
  const bool constant = graph.is_constant(v.args[0]) || graph.is_constant(v.args[1]);
  const bool turns = graph[v.args[0]].op == Op::kFloor || graph[v.args[1]].op == Op::kFloor;
  return constant && !turns;
}

}  // namespace

MixedArithmetic::MixedArithmetic(const Placement& placement, const Design& design)
    : parts_(placement.parts),
      crossings_(placement.crossings),
      against_arctan_(placement.against_arctan),
      to_digital_(placement.to_digital),
      gains_(parts_.size(), 1),
      widths_(parts_.size(), 1),
      method_(design.method),
      calibration_(design.calibration),
      arctan_(design.arctan),
      gaussian_(design.gaussian),
      clip_(design.cells.source_clip),
      comparator_noise_(design.cells.comparator_noise),
      quotient_dac_(design.dac, Direction::kToAnalog, -1, 1, design.seed, 0),
      angle_dac_(design.dac, Direction::kToAnalog, -kPi, kPi, design.seed, 1),
      input_dac_(design.dac, Direction::kToAnalog, -kWidest, kWidest, design.seed, 2),
      angle_adc_(design.adc, Direction::kToDigital, -kPi, kPi, design.seed, 3),
      weight_adc_(design.adc, Direction::kToDigital, 0, 1, design.seed, 4) {
  choose_gains(placement, design);
}

void MixedArithmetic::choose_gains(const Placement& placement, const Design& design) {
  const graph::Graph& graph = placement.recorded.graph;
  const double rms = arctan_ && calibration_ == Calibration::kInflate ? arctan_->facts().rms : 0;
  const bool cells = method_ != Method::kWeights;
  Draws{design.seed, 0}.for_each(kPartErrors, 0, parts_.size() + 1, [&](std::size_t id, auto& draw) {
    const double z = draw.normal();
    if (id == parts_.size()) {
      divider_gain_ = cells ? 1 + design.cells.divider_gain * z : 1;
      return;
    }
    const Vertex& v = graph[static_cast<Id>(id)];
    const double sd = parts_[id] == Part::kSource                            ? design.cells.source_gain
                      : parts_[id] == Part::kSquare                          ? design.cells.squarer_gain
                      : parts_[id] == Part::kCurrents && is_mirror(graph, v) ? design.cells.product_gain
                                                                             : 0;
    if (cells) gains_[id] = 1 + sd * z;
    if (placement.behind_arctan[id])
      widths_[id] = std::hypot(1, rms * inverse_sigma(placement, static_cast<Id>(id)).value_or(0));
  });
}

double MixedArithmetic::compute(Id id, const Vertex& vertex, const std::array<double, 4>& operands) {
  switch (parts_[id]) {
    case Part::kArctan: {
      const bool quotient = vertex.op == Op::kAtan;
      return digitised(id, angle_adc_, arctan(operands[0], quotient ? 1 : operands[1], divider_gain_, true));
    }
    case Part::kGaussian: {
      const bool crosses = method_ == Method::kWeights && crossings_[id] != 0;
      const double x = crosses ? input_dac_(operands[0], normal_for(input_dac_)) : operands[0];
      return gaussian(id, x / widths_[id]);
    }
    case Part::kSquare: {
      const double x = operands[0] / widths_[id];
      return -0.5 * gains_[id] * x * x + comparator_noise_ * normal();
    }
    default:
      break;
  }
  std::array<double, 4> values = operands;
  for (std::size_t k = 0; k < graph::arity(vertex.op); ++k)
    if ((crossings_[id] >> k & 1U) != 0) values[k] = crossing(id, values[k]);
  return gains_[id] * graph::apply<double>(vertex.op, values);
}

double MixedArithmetic::gaussian(Id id, double x) {
  return std::max(0.0, digitised(id, weight_adc_, circuit(*gaussian_, x, true)));
}

double MixedArithmetic::circuit(const Behaviour& behaviour, double x, bool noisy) const {
  if (std::isnan(x)) return x;
  const double y = behaviour(x);
  return noisy && draw_ != nullptr ? y + behaviour.noise_sd(x) * draw_->normal() : y;
}

double MixedArithmetic::digitised(Id id, const Converter& adc, double value) const {
  return to_digital_[id] ? adc(value, normal_for(adc)) : value;
}

double MixedArithmetic::arctan(double y, double x, double gain, bool noisy) const {
  const double most = method_ == Method::kWeights ? 1 : kRange;
  const bool steep = std::abs(y) > most * std::abs(x);
  const double below = steep ? y : x;
  double q = below == 0 ? 0 : gain * (steep ? x : y) / below;
  if (method_ == Method::kWeights && noisy) q = quotient_dac_(q, normal_for(quotient_dac_));
  const double angle = circuit(*arctan_, q, noisy);
  if (steep) return (y > 0 ? kPi / 2 : -kPi / 2) - angle;
  return x < 0 ? angle + (y < 0 ? -kPi : kPi) : angle;
}

double MixedArithmetic::transferred(double angle_rad) const {
  return arctan(std::sin(angle_rad), std::cos(angle_rad), divider_gain_, false);
}

double MixedArithmetic::crossing(Id id, double value) {
  if (value == last_crossing_ && id == last_crossed_) return last_crossed_value_;
  double crossed = against_arctan_[id] ? numbers::wrap(value) : value;
  if (against_arctan_[id] && calibration_ == Calibration::kTransfer) crossed = transferred(crossed);
  if (method_ == Method::kWeights) crossed = angle_dac_(crossed, normal_for(angle_dac_));
  if (method_ == Method::kWeights && angle_dac_.noisy()) return crossed;
  last_crossing_ = value;
  last_crossed_ = id;
  return last_crossed_value_ = crossed;
}

}  // namespace mote::analog
