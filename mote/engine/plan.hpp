#pragma once
/// The plan of a run: every choice that decides its numbers, as data.

#include <cstdint>
#include <string>

#include "mote/filter/options.hpp"

namespace mote {

enum class FilterKind { kSisr, kImh, kAuxiliary, kDistributed, kSqmc, kEkf, kUkf };
enum class Precision { kFloat, kDouble };

/// What to run. Defaults are the papers' filters.
struct Plan {
  FilterKind filter = FilterKind::kSisr;
  std::size_t particles = 1000;
  std::uint64_t seed = 1;
  Precision precision = Precision::kDouble;
  std::string proposal = "prior";
  SelectionOptions selection;
  ChainOptions chain;
  GroupOptions groups;
  OnCollapse on_collapse = OnCollapse::kStop;
};

/// Name of a filter as on the command line.
std::string_view name_of(FilterKind filter);

/// Whether a filter keeps one Gaussian law instead of particles.
inline bool is_gaussian(FilterKind filter) { return filter == FilterKind::kEkf || filter == FilterKind::kUkf; }

/// Bytes that a run of the reference engine needs for states of `dimensions` components, an upper bound.
double bytes_needed(const Plan& plan, std::size_t dimensions);

/// Refuses a plan whose numbers do not fit together (Refusal, kWrongUse), naming the option; `where` opens the
/// sentence.
void check(const Plan& plan, const std::string& where);

}  // namespace mote
