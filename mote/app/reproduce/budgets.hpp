#pragma once
/// Budgets: the powers of components of an item.

#include <string>
#include <utility>
#include <vector>

#include "mote/app/analog/power_request.hpp"
#include "mote/app/reproduce/item.hpp"
#include "mote/report/page.hpp"

namespace mote::reproduce {

/// The budgets of one item, one for each of its runs. There is no chance in them: their repeats are all the same.
class Budgets {
 public:
  /// error   Refusal (kBadData, kWrongUse) naming file:line for options that `mote analog power` does not have, or a
  ///         key that its JSON does not have
  explicit Budgets(const Item& item);

  std::size_t work() const { return requests_.size(); }
  /// What a comparison asks of one of its runs: a number of its JSON, yes as 1 and no as 0, nothing as NaN.
  double figure(const Comparison& comparison, std::size_t side) const;
  /// Power against the rate of particles, for the first run that a figure draws.
  report::Chart chart(const Figure& figure) const;

 private:
  std::vector<std::pair<std::string, PowerRequest>> requests_;
};

}  // namespace mote::reproduce
