#pragma once
/// Scenes: recordings with their truth, drawn from a model and kept in memory.

#include "mote/app/catalogue/catalogue.hpp"
#include "mote/engine/recording.hpp"

namespace mote {

/// A recording and the states behind it.
struct Scene {
  Recording recording;
  Truth truth;
};

/// Draws a recording of `steps` steps, the one that `mote simulate` writes for the seed.
Scene simulated_scene(const CatalogueModel& model, Step steps, std::uint64_t seed);

/// The columns doa1..doaM: a header that a model sizes itself by when there are no data yet.
std::vector<std::string> frame_header(long long columns);

}  // namespace mote
