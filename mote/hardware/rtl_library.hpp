#pragma once
/// The hand-written SystemVerilog of mote/hardware/rtl, which the program carries with it.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::hardware {

/// A file of the library: <module>.sv holds that module and no other.
struct RtlFile {
  std::string_view name;
  std::string_view text;
};

/// Every file of the library, in the order of the alphabet.
std::span<const RtlFile> rtl_library();

/// The files whose modules a text names outside its comments, and those that they name in turn, in the order of the
/// alphabet.
std::vector<RtlFile> needed_of_library(const std::string& text);

}  // namespace mote::hardware
