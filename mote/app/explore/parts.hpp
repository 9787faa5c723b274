#pragma once
/// What a circuit costs, by parts that several candidates share: each is synthesised once.

#include <functional>
#include <string>

#include "mote/app/explore/target.hpp"
#include "mote/hardware/machine/cost.hpp"

namespace mote::explore {

/// A machine of the same kind with as many lanes, which is synthesised whole and stands for others that hold more or
/// fewer particles, of other words.
struct Anchor {
  const hardware::Machine& machine;
  std::size_t particles;
};

/// A part with a name that tells its text from every other's.
struct Part {
  std::string name;
  std::function<hardware::PartCost()> synthesised;
};

/// The parts that a machine's cost follows from, two of them those of the anchor.
struct Parts {
  Part anchor, propose, weigh, anchors_propose, anchors_weigh;
};

Parts parts_of(const hardware::Machine& machine, const Anchor& anchor);

/// What a part costs, which the memory keeps.
///
/// error   Refusal (kOutsideTool) when yosys is missing or fails
/// cost    1 to 60 s where it is not remembered
hardware::PartCost remembered(const Part& part, Memory& memory);

/// The cost of a machine by hardware::cost_of_parts(). Look-up tables and flip-flops of a filter hardly depend on N
/// (some 20 a bit of it), memory blocks beside a table a lane grow with N/lanes from 512 on.
///
/// error   as remembered()
hardware::Cost cost_by_parts(const hardware::Machine& machine, std::size_t particles, const Anchor& anchor,
                             Memory& memory);

}  // namespace mote::explore
