#pragma once
/// The publication: figures, page and comparison of regenerated items.

#include <nlohmann/json_fwd.hpp>

#include "mote/app/reproduce/laboratory.hpp"
#include "mote/report/page.hpp"

namespace mote::reproduce {

/// An item with its outcome.
struct Regenerated {
  Item item;
  Outcome outcome;
};

/// [{item, paper, ours, ratio, holds, note}], one entry per comparison.
nlohmann::json comparison_json(const std::vector<Regenerated>& all);

/// The page of one or all papers.
report::Page page_of(const std::string& paper, const std::vector<Regenerated>& all, const std::string& command);

/// The numbers behind an item's figures: t, truth and each run's mean and sd of every state.
std::string figure_csv(const Outcome& outcome);

/// A file name for an item: "imh-hw-fig-5".
std::string slug(const Item& item);

}  // namespace mote::reproduce
