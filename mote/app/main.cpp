#include "mote/app/commands/command.hpp"
#include "mote/app/track/hand_over.hpp"

int main(int count, char** words) {
  using namespace mote;
  const auto hand_over = [words](const Arguments&) -> ExitCode { hand_over_to_tracker(words); };
  return run_program(count, words,
                     {models_command(), simulate_command(), run_command(), track_command(hand_over),
                      train_command(hand_over), compare_command(), bench_command(), reproduce_command()});
}
