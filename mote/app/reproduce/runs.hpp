#pragma once
/// Runs: the recordings of an item, and its filters at work on them.

#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "mote/analog/method.hpp"
#include "mote/app/catalogue/scene.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/reproduce/circuits.hpp"
#include "mote/app/reproduce/item.hpp"

namespace mote::reproduce {

/// The runs of one item: by engines, by circuits, by analog parts. What has run once is kept.
class Runs {
 public:
  /// Makes every model and plan.
  ///
  /// error   Refusal (kBadData) naming file:line for models, settings and options that do not exist
  explicit Runs(Item item);

  const Item& item() const { return item_; }
  const CatalogueModel& model() const { return *source_; }
  const std::vector<Quantity>& states() const { return states_; }
  /// The number of a state; nothing if the model has none of that name.
  std::optional<std::size_t> place_of(const std::string& state) const;
  /// Why analog parts cannot be simulated, in a sentence; empty if they can, or none are asked for.
  std::string missing() const;

  /// The recording of a repeat: the item's seed plus `offset`. Files have no other.
  const Scene& scene(std::uint64_t offset);
  /// A run on it, its filter's seed likewise.
  ///
  /// error   Refusal: the filter collapsed (kCollapsed), or as of its engine
  const RunRecord& record(const std::string& run, std::uint64_t recording_offset, std::uint64_t seed_offset);
  /// A run by any plan, whose record is not kept.
  RunRecord record(const Plan& plan, std::uint64_t recording_offset);
  /// The circuit of a run.
  CircuitBench& circuit(const std::string& run) { return *benches_.at(run).circuit; }

 private:
  struct Bench {
    Job job;
    Plan plan;
    std::shared_ptr<CircuitBench> circuit = nullptr;  ///< filters instead of the plan
    std::optional<Arguments> analog;                  ///< of a run by analog parts
    std::optional<analog::Design> design;             ///< its parts, simulated on first use
  };

  std::unique_ptr<CatalogueModel> model_with(const std::vector<std::string>& settings, const std::string& where) const;
  Bench bench_for(const Run& run) const;
  RunRecord mixed_record(Bench& bench, const Plan& plan) const;

  Item item_;
  std::vector<std::string> header_;
  std::unique_ptr<CatalogueModel> source_;
  std::vector<Quantity> states_;
  std::map<std::string, Bench> benches_;
  std::map<std::uint64_t, Scene> scenes_;
  std::map<std::tuple<std::string, std::uint64_t, std::uint64_t>, RunRecord> records_;
};

}  // namespace mote::reproduce
