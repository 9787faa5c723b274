#pragma once
/// Texts with places to fill in.

#include <map>
#include <string>
#include <string_view>

namespace mote {

/// A text with every @name@ replaced by its value; a name has lower-case letters, digits and underscores.
///
/// error   std::logic_error for a name without value
std::string filled_in(std::string_view text, const std::map<std::string, std::string>& values);

}  // namespace mote
