#include "mote/hardware/machine/templates.hpp"

#include <algorithm>
#include <stdexcept>

namespace mote::hardware {

std::string_view machine_template(std::string_view name) {
  const auto all = machine_templates();
  const auto found = std::find_if(all.begin(), all.end(), [&](const RtlFile& file) { return file.name == name; });
  if (found == all.end()) throw std::logic_error("no template " + std::string(name));
  return found->text;
}

}  // namespace mote::hardware
