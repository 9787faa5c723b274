#pragma once
/// Texts with places to fill in: the files of mote/hardware/machine/templates and driver, which the program carries.

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "mote/hardware/rtl_library.hpp"

namespace mote::hardware {

/// Every file of the two folders.
std::span<const RtlFile> machine_templates();

/// The text of one.
std::string_view machine_template(std::string_view name);

/// A text with every @name@ replaced by its value.
///
/// error   std::logic_error for a name without value
std::string filled_in(std::string_view text, const std::map<std::string, std::string>& values);

}  // namespace mote::hardware
