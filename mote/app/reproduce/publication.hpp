#pragma once
/// The publication: page and comparison of regenerated items.

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

/// The comparisons as lines for a terminal.
std::string comparison_text(const std::vector<Regenerated>& all);

/// The page of one or all papers; `command` made it.
report::Page page_of(const std::string& paper, const std::vector<Regenerated>& all, const std::string& command);

}  // namespace mote::reproduce
