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

/// Normal numbers that a converter or a circuit takes.
template <class P>
std::size_t taken_by(const P& part) {
  return part.noisy() ? 1 : 0;
}
template <class P>
double normal_for(const P& part, const Normals& noise, std::size_t k, std::size_t i) {
  return part.noisy() ? noise(k, i) : 0;
}

using Kernel = void (*)(const Columns&, double, std::size_t, double*);

template <Op op>
void each(const Columns& a, double gain, std::size_t count, double* out) {
  for (std::size_t i = 0; i < count; ++i)
    out[i] = gain * graph::apply<double>(op, {a[0][i], a[1][i], a[2][i], a[3][i]});
}

/// `gain` times an operation, by operation.
constexpr auto kKernels = []<std::size_t... k>(std::index_sequence<k...>) {
  return std::array<Kernel, sizeof...(k)>{&each<static_cast<Op>(k)>...};
}
(std::make_index_sequence<static_cast<std::size_t>(Op::kSelect) + 1>());

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

std::size_t MixedArithmetic::normals(Id id) const {
  const std::size_t of_adc = to_digital_[id] ? 1 : 0;
  switch (parts_[id]) {
    case Part::kArctan:
      return taken_by(quotient_dac_) + taken_by(*arctan_) + of_adc * taken_by(angle_adc_);
    case Part::kGaussian:
      return taken_by(input_dac_) + taken_by(*gaussian_) + of_adc * taken_by(weight_adc_);
    case Part::kSquare:
      return 1;
    default:
      return crossings_[id] == 0 ? 0 : taken_by(angle_dac_);
  }
}

void MixedArithmetic::compute(Id id, const Vertex& vertex, const Columns& operands, const Normals& noise,
                              std::size_t count, double* out) {
  switch (parts_[id]) {
    case Part::kArctan:
      return arctans(id, vertex, operands, noise, count, out);
    case Part::kGaussian:
      return gaussians(id, operands[0], noise, count, out);
    case Part::kSquare:
      for (std::size_t i = 0; i < count; ++i) {
        const double x = operands[0][i] / widths_[id];
        out[i] = -0.5 * gains_[id] * x * x + comparator_noise_ * noise(0, i);
      }
      return;
    default:
      break;
  }
  std::array<std::array<double, kTile>, 4> crossed;
  Columns values = operands;
  for (std::size_t k = 0; k < graph::arity(vertex.op); ++k) {
    if ((crossings_[id] >> k & 1U) == 0) continue;
    for (std::size_t i = 0; i < count; ++i)
      crossed[k][i] = crossing(id, operands[k][i], normal_for(angle_dac_, noise, 0, i));
    values[k] = crossed[k].data();
  }
  kKernels[static_cast<std::size_t>(vertex.op)](values, gains_[id], count, out);
}

void MixedArithmetic::arctans(Id id, const Vertex& vertex, const Columns& operands, const Normals& noise,
                              std::size_t count, double* out) const {
  const bool quotient = vertex.op == Op::kAtan;
  const std::size_t of_arctan = taken_by(quotient_dac_);
  const std::size_t of_adc = of_arctan + taken_by(*arctan_);
  for (std::size_t i = 0; i < count; ++i)
    out[i] = in_the_plane(operands[0][i], quotient ? 1 : operands[1][i], [&](double q) {
      const double in = method_ == Method::kWeights ? quotient_dac_(q, normal_for(quotient_dac_, noise, 0, i)) : q;
      return arctan_->noisy_at(in, normal_for(*arctan_, noise, of_arctan, i));
    });
  if (!to_digital_[id]) return;
  for (std::size_t i = 0; i < count; ++i) out[i] = angle_adc_(out[i], normal_for(angle_adc_, noise, of_adc, i));
}

void MixedArithmetic::gaussians(Id id, const double* x, const Normals& noise, std::size_t count, double* out) const {
  const bool crosses = method_ == Method::kWeights && crossings_[id] != 0;
  const std::size_t of_gaussian = taken_by(input_dac_);
  const std::size_t of_adc = of_gaussian + taken_by(*gaussian_);
  for (std::size_t i = 0; i < count; ++i) {
    const double in = crosses ? input_dac_(x[i], normal_for(input_dac_, noise, 0, i)) : x[i];
    const double y = gaussian_->noisy_at(in / widths_[id], normal_for(*gaussian_, noise, of_gaussian, i));
    out[i] = std::max(0.0, to_digital_[id] ? weight_adc_(y, normal_for(weight_adc_, noise, of_adc, i)) : y);
  }
}

double MixedArithmetic::transferred(double angle_rad) const {
  return in_the_plane(std::sin(angle_rad), std::cos(angle_rad), [&](double q) {
    return arctan_->noisy_at(method_ == Method::kWeights ? quotient_dac_(q, 0) : q, 0);
  });
}

double MixedArithmetic::crossing(Id id, double value, double normal) {
  if (value == last_crossing_ && id == last_crossed_) return last_crossed_value_;
  double crossed = against_arctan_[id] ? numbers::wrap(value) : value;
  const bool known = against_arctan_[id] && calibration_ == Calibration::kTransfer;
  if (known) crossed = transferred(crossed);
  if (method_ == Method::kWeights)
    crossed = known ? angle_dac_.calibrated(crossed, normal) : angle_dac_(crossed, normal);
  if (method_ == Method::kWeights && angle_dac_.noisy()) return crossed;
  last_crossing_ = value;
  last_crossed_ = id;
  return last_crossed_value_ = crossed;
}

}  // namespace mote::analog
