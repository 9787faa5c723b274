#pragma once
/// Files of a run: estimates, summary, particles.

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/files/output.hpp"
#include "mote/engine/run_record.hpp"

namespace mote {

/// The estimates as CSV: t, mean and sd of every state, ess, log_evidence, acceptance (IMH), then the functions asked
/// for.
std::string estimates_csv(const RunRecord& record);

/// The summary as JSON.
nlohmann::json summary_json(const RunRecord& record, const Summary& summary);

/// Header and lines of a particle dump: t, states, normalised weight.
std::string particles_header(const std::vector<Quantity>& states);
void write_particles(Output& out, Step t, const WeightedSet& set);

}  // namespace mote
