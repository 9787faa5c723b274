#include "mote/app/commands/command.hpp"

namespace mote {

Command design_command() {
  return {"design", "Find the best design for a budget", {}, {}, nullptr, "See mote design COMMAND --help."};
}

}  // namespace mote
