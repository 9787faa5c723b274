#pragma once
/// Clusters: the sweeps of an item on simulated clusters.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mote/app/commands/command.hpp"
#include "mote/app/reproduce/item.hpp"
#include "mote/app/simulated/publication.hpp"

namespace mote::reproduce {

/// The sweeps of one item, a sweep for each of its runs. A sweep has no chance in it: its repeats are all the same.
class Clusters {
 public:
  /// error   Refusal (kBadData, kWrongUse) naming file:line for options that `mote simulate-cluster` does not have
  explicit Clusters(const Item& item);

  /// Why the item cannot be regenerated: SimGrid is not there. Empty if it is.
  std::string missing() const;
  /// Sweeps.
  std::size_t work() const { return sweeps_.size(); }
  /// What a comparison asks of one of its runs; `ran` is called after every sweep.
  double figure(const Comparison& comparison, std::size_t side, const std::function<void()>& ran);
  /// All sweeps, by the item's runs.
  std::vector<std::pair<std::string, simulated::Sweep>> sweeps(const std::function<void()>& ran);

 private:
  struct Asked {
    Arguments arguments;
    simulated::Sweep sweep;
  };
  const simulated::Sweep& sweep(const std::string& run, const std::function<void()>& ran);

  std::string file_;
  std::vector<std::string> names_;
  std::map<std::string, Asked> sweeps_;
};

}  // namespace mote::reproduce
