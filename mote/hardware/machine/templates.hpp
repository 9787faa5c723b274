#pragma once
/// Texts with places to fill in: the files of mote/hardware/machine/templates and driver, which the program carries.

#include <span>
#include <string_view>

#include "mote/hardware/rtl_library.hpp"

namespace mote::hardware {

/// Every file of the two folders.
std::span<const RtlFile> machine_templates();

/// The text of one.
std::string_view machine_template(std::string_view name);

}  // namespace mote::hardware
