#include "mote/app/catalogue/scene.hpp"

namespace mote {

Scene simulated_scene(const CatalogueModel& model, Step steps, std::uint64_t seed) {
  Scene scene;
  for (const Column& column : model.columns())
    if (!column.input) scene.recording.observations.push_back(column);
  scene.truth.known.assign(model.states().size(), true);
  model.simulate(steps, seed, [&](Step t, std::span<const double> state, const Row<double>& row) {
    scene.recording.steps.push_back({t, {row}});
    scene.truth.states[t].assign(state.begin(), state.end());
    return true;
  });
  return scene;
}

std::vector<std::string> frame_header(long long columns) {
  std::vector<std::string> header;
  for (long long m = 1; m <= columns; ++m) header.push_back("doa" + std::to_string(m));
  return header;
}

}  // namespace mote
