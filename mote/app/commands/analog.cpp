#include "mote/app/commands/command.hpp"

namespace mote {

Command analog_command() {
  return {"analog", "Analog circuits in a filter: what they do, and what they save",
          {},       {},
          nullptr,  "See mote analog COMMAND --help."};
}

}  // namespace mote
