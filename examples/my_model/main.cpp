// Simulates the pendulum, filters the data with both of the papers' filters, and prints what they make of it.

#include <cstdio>

#include "my_model.hpp"
#include <mote/engine/run.hpp>
#include <mote/filter/imh.hpp>
#include <mote/filter/sisr.hpp>

static_assert(mote::Observable<Pendulum>);

namespace {

struct Simulation {
  mote::Recording recording;
  mote::Truth truth{{true, true}, {}};
};

Simulation simulate(const Pendulum& model, mote::Step steps) {
  Simulation all;
  auto block = mote::Draws{7}.block(mote::Purpose::kObserve);
  auto draw = block.particle(0);
  auto x = model.initial<double>(draw);
  for (mote::Step t = 1; t <= steps; ++t) {
    x = model.next<double>(t, x, draw);
    mote::ObservedStep step{t, {}, {}};
    if (t % 10 != 0)
      step.rows.push_back(model.observe<double>(t, x, mote::blank_row(model), draw));  // every tenth is missed
    all.recording.steps.push_back(step);
    all.truth.states[t] = {x[0], x[1]};
  }
  return all;
}

void print(const char* name, mote::Filter& filter, const Pendulum& model, const Simulation& simulation) {
  mote::RunRequest request;
  request.states = model.states();
  const mote::RunRecord record = mote::run(filter, mote::Plan{}, simulation.recording, request);
  std::printf("%s\n    t    truth     mean       sd  [rad]\n", name);
  for (const mote::EstimateRow& row : record.rows)
    if (row.t % 20 == 0)
      std::printf("%5d %8.3f %8.3f %8.3f\n", row.t, simulation.truth.states.at(row.t)[0], row.states[0].mean,
                  row.states[0].sd);
  const mote::Summary summary = mote::summarise(record, &simulation.truth);
  std::printf("%s: rmse of the angle %.4f rad, log evidence %.3f\n", name, summary.rmse[0], summary.log_evidence);
}

}  // namespace

int main() {
  const Pendulum model;
  const Simulation simulation = simulate(model, 200);
  constexpr std::size_t kParticles = 2000;
  constexpr std::uint64_t kSeed = 1;
  print("sisr", *mote::make_sisr(model, kParticles, kSeed), model, simulation);
  print("imh", *mote::make_imh(model, kParticles, kSeed), model, simulation);
}
