#include "mote/hardware/rtl_library.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {

void write_rtl_library(const std::string& folder) {
  for (const RtlFile& file : rtl_library()) write_text(folder + "/" + std::string(file.name), std::string(file.text));
}

}  // namespace mote::hardware
