#pragma once
/// Makes a catalogue entry of a model: everything the program does with it, instantiated here and nowhere else.

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/engine/cast.hpp"
#include "mote/software/engines.hpp"
#include "mote/software/proposals.hpp"

namespace mote {

/// The recording of a model with the proposal of that name.
///
/// error   Refusal (kWrongUse): the model has none of that name, or its weights do not exist
template <Model M>
graph::Recorded recorded_with_proposal(const M& model, const std::string& proposal, const std::string& where) {
  if (proposal == Prior::kName) return graph::record(model);
  std::optional<graph::Recorded> made;
  const auto offer = [&]<class G>(std::type_identity<G>) {
    if constexpr (!std::is_same_v<G, Prior>) {
      if (proposal != G::kName) return;
      if (density_of(model) == Density::kNone) refuse_proposal_without_density(proposal, where);
      made = graph::record_with<G>(model);
    }
  };
  if constexpr (requires { typename M::Proposals; }) {
    [&]<class... G>(const std::tuple<G...>*) {
      (offer(std::type_identity<G>()), ...);
    }(static_cast<const typename M::Proposals*>(nullptr));
  }
  if (!made) refuse_unknown_proposal(proposal, where);
  return *std::move(made);
}

template <Observable M>
class CatalogueModelOf final : public CatalogueModel {
 public:
  explicit CatalogueModelOf(M model) : model_(std::move(model)) {}

  std::vector<Quantity> states() const override { return model_.states(); }
  std::vector<Column> columns() const override { return model_.columns(); }
  std::vector<ValueSource> sources() const override { return value_sources(model_); }
  std::unique_ptr<Filter> filter(const Plan& plan, const std::string& where) const override {
    switch (engine_of(plan)) {
      case Engine::kMpi:
        if (plan.team == nullptr) refuse_without_team(where);
        if (plan.filter == FilterKind::kDistributed) return reference_filter(model_, plan, where);
        if (has_cast(plan)) return ranked_filter(model_, plan, where);
        [[fallthrough]];
      case Engine::kSimd:
        return simd_filter(model_, plan, where);
      case Engine::kPipeline:
        return pipeline_filter(model_, plan, where);
      default:
        return reference_filter(model_, plan, where);
    }
  }
  using CatalogueModel::recorded;
  graph::Recorded recorded(const std::string& proposal, const std::string& where) const override {
    return recorded_with_proposal(model_, proposal, where);
  }
  std::unique_ptr<CatalogueModel> part() const override {
    if constexpr (requires { model_.part(); }) {
      using Part = decltype(model_.part());
      return std::make_unique<CatalogueModelOf<Part>>(model_.part());
    } else {
      return nullptr;
    }
  }
  std::unique_ptr<referee::Solver> solver() const override { return referee::solver_of(model_); }

  using CatalogueModel::simulate;
  void simulate(Step steps, std::uint64_t seed, const SimulationVisit& visit) const override {
    const Row<double> inputs = blank_row(model_);
    std::vector<double> shown;
    auto prior = Draws{seed, 0}.block(Purpose::kTruth);
    auto draw = prior.particle(0);
    StateOf<M, double> x = model_.template initial<double>(draw);
    for (Step t = 1; t <= steps; ++t) {
      const Draws draws{seed, static_cast<std::uint32_t>(t)};
      auto moves = draws.block(Purpose::kTruth);
      auto observations = draws.block(Purpose::kObserve);
      auto move_draw = moves.particle(0);
      auto observe_draw = observations.particle(0);
      x = model_.template next<double>(t, x, move_draw);
      shown.assign(x.begin(), x.end());
      if (!visit(t, shown, model_.template observe<double>(t, x, inputs, observe_draw))) return;
    }
  }

 private:
  M model_;
};

/// The names and meanings of a model's proposals.
template <class M>
std::vector<Named> proposals_of() {
  return []<class... G>(const std::tuple<G...>*) {
    return std::vector<Named>{{std::string(G::kName), std::string(G::kMeaning)}...};
  }(static_cast<const typename M::Proposals*>(nullptr));
}

/// A model's parameters with their defaults.
template <class M>
std::vector<ParameterInfo> parameters_of() {
  std::vector<ParameterInfo> all;
  const typename M::Parameters defaults{};
  for (const auto& p : M::kParameters) {
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", defaults.*(p.value));
    all.push_back({std::string(p.name), std::string(p.unit), text, words_for(p.range), std::string(p.meaning)});
  }
  return all;
}

/// The model's parameters as set.
template <class M>
typename M::Parameters parameters_from(const Settings& settings) {
  typename M::Parameters parameters{};
  for (const auto& p : M::kParameters)
    parameters.*(p.value) = settings.number(std::string(p.name), parameters.*(p.value), p.range);
  return parameters;
}

/// Names of a model's parameters, and of what else it can be set to.
template <class M>
std::vector<std::string> parameter_names_of(const std::vector<std::string>& others = {}) {
  std::vector<std::string> names;
  for (const auto& p : M::kParameters) names.emplace_back(p.name);
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

template <class M>
std::unique_ptr<CatalogueModel> wrapped(M model) {
  return std::make_unique<CatalogueModelOf<M>>(std::move(model));
}

/// Fills in the columns and states that the entry shows for a model at its defaults.
template <class M>
CatalogueEntry shown(CatalogueEntry entry, const M& model) {
  for (const Column& c : model.columns()) entry.example_columns.push_back(c.name);
  entry.example_states = model.states();
  return entry;
}

/// The entry of a model that is nothing but its parameters.
template <Observable M>
CatalogueEntry entry(std::string name, std::string meaning) {
  CatalogueEntry made{std::move(name), std::move(meaning), parameters_of<M>(), proposals_of<M>(), {}, {}, nullptr};
  made.build = [](const std::string& model_name, const Settings& settings, std::span<const std::string>) {
    M model{parameters_from<M>(settings)};
    settings.finish(model_name, parameter_names_of<M>());
    return wrapped(std::move(model));
  };
  return shown(std::move(made), M{});
}

}  // namespace mote
