#include "mote/app/commands/command.hpp"
#include "mote/app/commands/hand_over.hpp"

int main(int count, char** words) {
  using namespace mote;
  const auto to_tracker = [words](const Arguments&) -> ExitCode { hand_over_to_tracker(words); };
  const auto to_team = [words](const Arguments&) -> ExitCode { hand_over_to_team(words); };
  return run_program(
      count, words,
      {models_command(),          simulate_command(),       run_command(to_team),      track_command(to_tracker),
       train_command(to_tracker), compare_command(),        graph_command(),           rtl_command(),
       design_command(),          design_measure_command(), design_optimise_command(), design_explore_command(),
       design_laws_command(),     design_check_command(),   analog_command(),          analog_characterise_command(),
       analog_run_command(),      analog_power_command(),   bench_command(),           reproduce_command(),
       simulate_cluster_command()});
}
