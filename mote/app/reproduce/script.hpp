#pragma once
/// An item as commands: the lines of a shell that make its recording and its runs again.

#include <string>

#include "mote/app/reproduce/item.hpp"

namespace mote::reproduce {

/// `mote simulate` for the item's recording and `mote run` for each of its runs, by name of file:
/// "imh-hw-fig-5-data.csv", "imh-hw-fig-5-imh.csv". `mote track` for the runs of an item on a clip. Empty for
/// an item on weights or on a drawn clip, which no other command makes.
std::string script_for(const Item& item);

}  // namespace mote::reproduce
