#include "mote/app/track/track.hpp"
#include "mote/app/track/train.hpp"

int main(int count, char** words) {
  using namespace mote;
  return run_program(count, words, {track_command(run_track), train_command(run_train)});
}
