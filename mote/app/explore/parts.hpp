#pragma once
/// What a circuit costs, by parts that several candidates share: each is synthesised once.

#include <string>

#include "mote/app/explore/target.hpp"
#include "mote/hardware/machine/cost.hpp"

namespace mote::explore {

/// A machine of the same kind with as many lanes, whose filter stands for others that hold more or fewer particles.
struct Anchor {
  const hardware::Machine& machine;
  std::size_t particles;
};

/// The cost of a machine by hardware::cost_of_parts(); `pipelines` names what its pipelines are. Its filter is the
/// anchor's: look-up tables and flip-flops hardly depend on N (some 20 a bit of it), memory blocks beside a table a
/// lane grow with N/lanes from 512 on.
///
/// error   Refusal (kOutsideTool) when yosys is missing or fails
/// cost    5 to 60 s a part that is not remembered
hardware::Cost cost_by_parts(const hardware::Machine& machine, std::size_t particles, const std::string& pipelines,
                             const Anchor& anchor, Memory& memory);

}  // namespace mote::explore
