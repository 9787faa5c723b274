#pragma once
/// Designs: the convex programs and exact schedules of an item.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mote/app/design/report.hpp"
#include "mote/app/reproduce/item.hpp"

namespace mote::reproduce {

/// A design's time against a number of blocks, by the laws and by the exact schedule.
struct DesignCurve {
  std::string run;
  std::vector<double> blocks = {}, law = {}, exact = {};
};

/// The designs of one item, one for each of its runs. There is no chance in them: their repeats are all the same.
class Designs {
 public:
  /// error   Refusal (kBadData, kWrongUse) naming file:line for options that `mote design optimise` does not have, or a
  /// key
  ///         that its JSON does not have
  explicit Designs(const Item& item);

  std::size_t work() const { return reports_.size(); }
  /// What a comparison asks of one of its runs: a number of its JSON, yes as 1 and no as 0, nothing as NaN.
  double figure(const Comparison& comparison, std::size_t side) const;
  /// A figure's curves, a run each, or of those that it names.
  std::vector<DesignCurve> curves(const Figure& figure) const;

 private:
  std::vector<std::pair<std::string, DesignReport>> reports_;
};

}  // namespace mote::reproduce
