#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"
#include "mote/hardware/piecewise.hpp"

namespace mote::hardware {
namespace {

using Function = std::function<double(double)>;

/// Coefficients in d of the parabola or line through three or two Chebyshev points of [-1/2, 1/2].
std::array<double, 3> interpolant(const std::function<double(double)>& at, int degree) {
  if (degree == 1) {
    const double node = 0.5 * std::cos(kPi / 4);
    const double low = at(-node);
    const double high = at(node);
    return {(low + high) / 2, (high - low) / (2 * node), 0};
  }
  const double node = 0.5 * std::cos(kPi / 6);
  const double low = at(-node);
  const double middle = at(0);
  const double high = at(node);
  return {middle, (high - low) / (2 * node), (high - 2 * middle + low) / (2 * node * node)};
}

std::int32_t coefficient(double value) {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max() / 2;
  return static_cast<std::int32_t>(std::nearbyint(std::clamp(value, -kMost, kMost)));
}

}  // namespace

/// The segments of a shape, as the numbers that fall into them.
class PiecewiseFit {
 public:
  PiecewiseFit(const Function& function, const PiecewiseShape& shape)
      : function_(&function), shape_(shape), unit_(shape, std::vector<Piecewise::Coefficients>(shape.entries())) {}

  /// A segment: u in [first, first + length), in steps of x; a length below 1 may hold no number.
  struct Segment {
    double first, length;
    bool negative;
  };

  Segment segment_of(std::size_t entry) const {
    const std::size_t segment = entry & ((std::size_t{1} << shape_.segment_bits) - 1);
    const std::size_t row = entry >> shape_.segment_bits;
    const std::size_t rows = std::size_t{1} << unit_.region_bits_;
    const int region = static_cast<int>(row % rows);
    const double start = region == 0 ? 0 : std::ldexp(1.0, shape_.bottom + region - 1);
    const double length = std::ldexp(1.0, shape_.bottom + std::max(0, region - 1) - shape_.segment_bits);
    return {start + static_cast<double>(segment) * length, length, unit_.sides_ && row >= rows};
  }

  /// The value in steps of y at a place that need not be a number of the format.
  double wanted(double u, bool negative) const {
    double x = negative ? shape_.centre - u : shape_.centre + u;
    if (shape_.fold == Fold::kPlain) x = u + static_cast<double>(shape_.x.least());
    if (shape_.fold == Fold::kMirrored) x = u;
    x = std::clamp(x, static_cast<double>(shape_.x.least()), static_cast<double>(shape_.x.greatest()));
    const double steps = std::ldexp((*function_)(x * shape_.x.step()), shape_.y.fraction);
    // where y saturates the polynomial may run on, so that no segment has a kink; infinities end somewhere
    const double reach = std::ldexp(4.0, shape_.y.width());
    return std::isnan(steps) ? 0.0 : std::clamp(steps, -reach, reach);
  }

  /// A number at which a shape missed its goal: others of the same function are likely to miss it there.
  struct Hard {
    std::uint64_t u = 0;
    bool negative = false;
  };

  /// The unit, unless one of its segments misses the goal at 17 numbers or then at `points`.
  std::optional<Piecewise> fitted_within(double steps, std::uint64_t points, Hard& hard) {
    const auto keeps = [&](std::size_t entry) {
      unit_.table_[entry] = coefficients(segment_of(entry));
      return within(unit_, entry, steps, 17, hard);
    };
    if (!all_keep(keeps, hard) || !good(unit_, steps, points, hard)) return {};
    return unit_;
  }

  /// Does every segment keep to the goal at so many numbers? Stops at the first that does not.
  bool good(const Piecewise& unit, double steps, std::uint64_t points, Hard& hard) const {
    return all_keep([&](std::size_t entry) { return within(unit, entry, steps, points, hard); }, hard);
  }

  Piecewise fitted() {
    for (std::size_t entry = 0; entry < unit_.table_.size(); ++entry)
      unit_.table_[entry] = coefficients(segment_of(entry));
    return unit_;
  }

  /// The greatest error of a segment at so many numbers, in steps of y, and where it is.
  struct Error {
    double steps = 0;
    std::uint64_t u = 0;
  };
  Error error_in(const Piecewise& unit, const Segment& segment, std::uint64_t points) const {
    Error worst;
    for_numbers(segment, unit_.u_greatest_, points, [&](std::uint64_t u) {
      const auto cell = unit.cell_of(u, segment.negative);
      const auto& c = unit.table_[cell.entry];
      const Word slope = c.c1 + ((c.c2 * cell.delta) >> unit.delta_bits_);
      const Word kept = (c.c0 + ((slope * cell.delta) >> unit.delta_bits_)) >> shape_.guard;
      const Format& y = shape_.y;
      const double want = std::clamp(wanted(static_cast<double>(u), segment.negative), static_cast<double>(y.least()),
                                     static_cast<double>(y.greatest()));
      const double error = std::abs(static_cast<double>(std::clamp(kept, y.least(), y.greatest())) - want);
      if (error > worst.steps) worst = {error, u};
    });
    return worst;
  }

 private:
  bool within(const Piecewise& unit, std::size_t entry, double steps, std::uint64_t points, Hard& hard) const {
    const Segment segment = segment_of(entry);
    const Error worst = error_in(unit, segment, points);
    if (worst.steps <= steps) return true;
    hard = {worst.u, segment.negative};
    return false;
  }
  template <class Keeps>
  bool all_keep(Keeps keeps, const Hard& hard) const {
    if (!keeps(unit_.cell_of(hard.u, hard.negative).entry)) return false;
    for (std::size_t entry = 0; entry < shape_.entries(); ++entry)
      if (!keeps(entry)) return false;
    return true;
  }

  /// Calls visit(u) for up to `points` numbers of the segment, the first and the last among them.
  template <class Visit>
  static void for_numbers(const Segment& segment, std::uint64_t greatest, std::uint64_t points, Visit visit) {
    const auto first = static_cast<std::uint64_t>(std::ceil(segment.first));
    const auto end = std::min(static_cast<std::uint64_t>(std::ceil(segment.first + segment.length)), greatest + 1);
    if (first >= end) return;
    const std::uint64_t count = end - first;
    if (count <= points) {
      for (std::uint64_t u = first; u < end; ++u) visit(u);
      return;
    }
    for (std::uint64_t i = 0; i < points; ++i) visit(first + i * (count - 1) / (points - 1));
  }

  /// The polynomial of a segment; its constant halves the range of what rounding and the other two leave over.
  Piecewise::Coefficients coefficients(const Segment& segment) const {
    // what truncation of the place in long segments hides is centred
    const double hidden = std::max(0.0, (std::ldexp(segment.length, -unit_.delta_bits_) - 1) / 2);
    const double unit = std::ldexp(1.0, shape_.guard);
    const auto at = [&](double d) {
      return wanted(segment.first + (d + 0.5) * segment.length + hidden, segment.negative) * unit;
    };
    const auto c = interpolant(at, shape_.degree);
    Piecewise::Coefficients chosen{0, coefficient(c[1]), coefficient(c[2])};
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for_numbers(segment, unit_.u_greatest_, 33, [&](std::uint64_t u) {
      const Word delta = unit_.cell_of(u, segment.negative).delta;
      const Word slope = chosen.c1 + ((chosen.c2 * delta) >> unit_.delta_bits_);
      const double left = wanted(static_cast<double>(u), segment.negative) * unit -
                          static_cast<double>((slope * delta) >> unit_.delta_bits_);
      least = std::min(least, left);
      most = std::max(most, left);
    });
    if (least > most) return {0, 0, 0};
    chosen.c0 = coefficient((least + most) / 2) + (1 << (shape_.guard - 1));
    return chosen;
  }

  const Function* function_;
  PiecewiseShape shape_;
  Piecewise unit_;
};

Piecewise fit_shape(const Function& function, const PiecewiseShape& shape) {
  return PiecewiseFit(function, shape).fitted();
}

namespace {

/// The shape of the fewest segments for one bottom that is good at so many numbers of each, if it is smaller than the
/// last.
void improve(std::vector<Piecewise>& found, const Function& function, PiecewiseShape shape, const FitGoal& goal,
             std::uint64_t points, PiecewiseFit::Hard& hard) {
  for (shape.segment_bits = 1; shape.segment_bits < shape.u_bits() && shape.segment_bits <= 12; ++shape.segment_bits) {
    const std::size_t limit = found.empty() ? goal.most_entries : found.back().shape().entries() - 1;
    if (shape.entries() > limit) return;
    std::optional<Piecewise> unit = PiecewiseFit(function, shape).fitted_within(goal.steps, points, hard);
    if (!unit) continue;
    found.push_back(std::move(*unit));
    return;
  }
}

}  // namespace

Piecewise fit_piecewise(const Function& function, const Format& x, const Format& y, Fold fold, int centre,
                        const FitGoal& goal) {
  PiecewiseShape shape{x, y, fold, centre, 0, 1, goal.degree, 4, goal.multiplier};
  constexpr std::uint64_t kMany = 4097;
  PiecewiseFit::Hard hard;
  for (const std::uint64_t points : {std::uint64_t{65}, kMany}) {  // few as a rule are enough to choose by
    std::vector<Piecewise> found;
    for (shape.bottom = shape.u_bits(); shape.bottom >= 1; --shape.bottom)
      improve(found, function, shape, goal, points, hard);
    if (found.empty()) break;  // nor is anything good at more numbers
    for (; !found.empty(); found.pop_back())
      if (PiecewiseFit(function, found.back().shape()).good(found.back(), goal.steps, kMany, hard))
        return std::move(found.back());
  }
  throw Refusal(ExitCode::kWrongUse, {"piecewise polynomial", "x " + x.name() + ", y " + y.name(),
                                      "an error of at most " + std::to_string(goal.steps) + " steps with at most " +
                                          std::to_string(goal.most_entries) + " segments",
                                      "more", "Give y fewer fraction bits or allow a greater error."});
}

double worst_error(const Piecewise& unit, const Function& function, std::uint64_t points) {
  const PiecewiseFit fit(function, unit.shape());
  double worst = 0;
  for (std::size_t entry = 0; entry < unit.shape().entries(); ++entry)
    worst = std::max(worst, fit.error_in(unit, fit.segment_of(entry), points).steps);
  return worst;
}

}  // namespace mote::hardware
