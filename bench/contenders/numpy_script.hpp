#pragma once
#include <string>

namespace mote::contenders {

/// The text of numpy_filter.py, compiled in: an installed program has no bench/.
std::string numpy_script();

}  // namespace mote::contenders
