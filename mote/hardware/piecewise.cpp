#include "mote/hardware/piecewise.hpp"

#include <cmath>

namespace mote::hardware {
namespace {

int signed_width(std::int32_t value) {
  return 1 + static_cast<int>(std::bit_width(static_cast<std::uint32_t>(value < 0 ? ~value : value)));
}

__extension__ using Bits = unsigned __int128;

Bits field(std::int32_t value, int width) { return static_cast<std::uint32_t>(value) & ((Bits{1} << width) - 1); }

}  // namespace

int PiecewiseShape::u_bits() const {
  if (fold == Fold::kPlain) return x.width();
  if (fold == Fold::kMirrored) return x.width() - 1;
  return static_cast<int>(
      std::bit_width(static_cast<std::uint64_t>(std::max(x.greatest() - centre, centre - x.least() - 1))));
}

int PiecewiseShape::delta_bits() const {
  const int longest = (regions() > 1 ? std::max(u_bits() - 1, bottom) : u_bits()) - segment_bits;
  return std::clamp(longest, 2, 17);
}

std::size_t PiecewiseShape::entries() const {
  const int bits = segment_bits + ceil_log2(static_cast<std::uint64_t>(regions())) + (fold == Fold::kSides ? 1 : 0);
  return std::size_t{1} << bits;
}

Piecewise::Piecewise(const PiecewiseShape& shape, std::vector<Coefficients> table)
    : shape_(shape),
      table_(std::move(table)),
      u_greatest_((std::uint64_t{1} << shape.u_bits()) - 1),
      delta_bits_(shape.delta_bits()),
      region_bits_(ceil_log2(static_cast<std::uint64_t>(shape.regions()))),
      octaves_(shape.regions() > 1),
      sides_(shape.fold == Fold::kSides),
      odd_(shape.fold == Fold::kOdd || shape.fold == Fold::kMirrored) {}

Piecewise::Widths Piecewise::widths() const {
  Widths widths{shape_.guard + 2, 2, 2};
  for (const Coefficients& c : table_) {
    widths.c0 = std::max(widths.c0, signed_width(c.c0));
    widths.c1 = std::max(widths.c1, signed_width(c.c1));
    widths.c2 = std::max(widths.c2, signed_width(c.c2));
  }
  return widths;
}

std::size_t Piecewise::memory_bits() const {
  const auto [c0, c1, c2] = widths();
  return table_.size() * static_cast<std::size_t>(c0 + c1 + (shape_.degree == 1 ? 0 : c2));
}

Circuit Piecewise::circuit() const {
  const auto [c0, c1, c2] = widths();
  Memory memory{"Table", c0 + c1 + (shape_.degree == 1 ? 0 : c2), {}};
  for (const Coefficients& c : table_)
    memory.words.push_back((shape_.degree == 1 ? 0 : field(c.c2, c2) << (c0 + c1)) | (field(c.c1, c1) << c0) |
                           field(c.c0, c0));
  const int latency = cell_latency() + shape_.degree * (product_latency(shape_.multiplier, delta_bits_) + 1) + 1;
  return {"mote_piecewise",
          {parameter("XSigned", shape_.x.sign), parameter("XWidth", shape_.x.width()),
           parameter("Fold", static_cast<int>(shape_.fold)), parameter("Centre", shape_.centre),
           parameter("UWidth", shape_.u_bits()), parameter("Bottom", shape_.bottom),
           parameter("SegmentBits", shape_.segment_bits), parameter("DeltaBits", delta_bits_),
           parameter("Degree", shape_.degree), parameter("C0Width", c0), parameter("C1Width", c1),
           parameter("C2Width", c2), parameter("Guard", shape_.guard), parameter("YSigned", shape_.y.sign),
           parameter("YWidth", shape_.y.width()), parameter("Logic", shape_.multiplier == Multiplier::kLogic)},
          {port("x_i", shape_.x)},
          {port("y_o", shape_.y)},
          latency,
          false,
          {std::move(memory)},
          {},
          Sharing::kAlike};
}

int Piecewise::cell_latency() const {
  const int folding = shape_.fold == Fold::kPlain ? 0 : shape_.fold == Fold::kMirrored ? 1 : 2;
  return folding + (octaves_ ? 3 : 0) + 2;
}

std::vector<Format> PiecewiseCell::formats() const {
  const auto [c0, c1, c2] = unit.widths();
  return {{true, c0 - 1, 0}, {true, c1 - 1, 0}, {true, c2 - 1, 0}, {true, unit.delta_bits_ - 1, 0}, {false, 1, 0}};
}

void PiecewiseCell::compute(Columns in, Results out) const {
  for (std::size_t i = 0; i < out[0].size(); ++i) {
    const auto [u, negative] = unit.place_of(in[0][i]);
    const auto [entry, delta] = unit.cell_of(u, negative);
    const auto& [c0, c1, c2] = unit.table_[entry];
    out[0][i] = c0;
    out[1][i] = c1;
    out[2][i] = unit.shape_.degree == 1 ? 0 : c2;
    out[3][i] = delta;
    out[4][i] = negative ? 1 : 0;
  }
}

/// Parameters and table are the unit's, but for what it makes of the polynomial.
Circuit PiecewiseCell::circuit() const {
  Circuit cell = unit.circuit();
  cell.module = "mote_piecewise_cell";
  std::erase_if(cell.parameters, [](const Parameter& one) {
    return one.name == "Guard" || one.name == "YSigned" || one.name == "YWidth" || one.name == "Logic";
  });
  const std::vector<Format> words = formats();
  cell.outputs = {port("c0_o", words[0]), port("c1_o", words[1]), port("c2_o", words[2]), port("delta_o", words[3]),
                  port("side_o", words[4])};
  cell.latency = unit.cell_latency();
  return cell;
}

}  // namespace mote::hardware
