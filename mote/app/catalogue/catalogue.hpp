#pragma once
/// The catalogue: every model of the program, with its type behind one face.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mote/app/catalogue/settings.hpp"
#include "mote/base/draws.hpp"
#include "mote/engine/estimand.hpp"
#include "mote/engine/plan.hpp"
#include "mote/filter/filter.hpp"
#include "mote/graph/record.hpp"
#include "mote/referee/solver.hpp"

namespace mote {

/// A simulated recording: per step the true state and a row.
struct Simulation {
  std::vector<std::vector<double>> states;  ///< (T, D)
  std::vector<Row<double>> rows;            ///< (T,)
};

/// Takes one simulated step: its true state and its row; false ends the simulation.
using SimulationVisit = std::function<bool(Step t, std::span<const double> state, const Row<double>& row)>;

/// A model with its parameters set, whatever its type.
class CatalogueModel {
 public:
  virtual ~CatalogueModel() = default;
  virtual std::vector<Quantity> states() const = 0;
  virtual std::vector<Column> columns() const = 0;
  virtual std::vector<ValueSource> sources() const = 0;
  /// A filter on the plan's engine.
  virtual std::unique_ptr<Filter> filter(const Plan& plan, const std::string& where) const = 0;
  /// The model as a graph; with a proposal other than "prior" that one's, too.
  ///
  /// error   Refusal (kWrongUse): no proposal of that name, or no weights for it
  graph::Recorded recorded() const { return recorded("prior", ""); }
  virtual graph::Recorded recorded(const std::string& proposal, const std::string& where) const = 0;
  /// The model of which this one is independent copies, states and columns copy after copy; nullptr: of none.
  virtual std::unique_ptr<CatalogueModel> part() const = 0;
  /// What solves the model's recordings exactly; nullptr: nothing known.
  virtual std::unique_ptr<referee::Solver> solver() const = 0;
  /// Draws a recording step by step, in no more memory than a step needs.
  virtual void simulate(Step steps, std::uint64_t seed, const SimulationVisit& visit) const = 0;
  /// Draws a whole recording.
  Simulation simulate(Step steps, std::uint64_t seed) const;
};

/// A name with what it means, for lists.
struct Named {
  std::string name, meaning;
};

/// A parameter as the catalogue shows it.
struct ParameterInfo {
  std::string name, unit, fallback, allowed, meaning;
};

/// One model of the catalogue.
struct CatalogueEntry {
  std::string name, meaning;
  std::vector<ParameterInfo> parameters;
  std::vector<Named> proposals;
  std::vector<std::string> example_columns;  ///< the columns of its data, at default settings
  std::vector<Quantity> example_states;
  /// Makes the model from `--set` settings; `header` holds the data's column names (a model may size itself by them).
  std::unique_ptr<CatalogueModel> make(const Settings& settings, std::span<const std::string> header) const {
    return build(name, settings, header);
  }
  std::function<std::unique_ptr<CatalogueModel>(const std::string& model_name, const Settings& settings,
                                                std::span<const std::string> header)>
      build;
};

/// All models, in the order of models.txt.
const std::vector<CatalogueEntry>& catalogue();

/// Refuses --engine mpi where no team of processes was started.
[[noreturn]] void refuse_without_team(const std::string& where);

/// The entry of that name, or of the model given as text in a .toml file.
///
/// error   Refusal (kWrongUse) that lists the names there are; Refusal (kBadData) when the file is no model
CatalogueEntry find_model(const std::string& name, const std::string& where);

}  // namespace mote
