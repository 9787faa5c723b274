#pragma once
/// SystemVerilog as Yosys 0.23 (Debian 12) reads it.

#include <string>

namespace mote::hardware {

/// The same module without what that Yosys has no grammar for: packed arrays of several dimensions become vectors,
/// named types of vectors their ranges, `return` in a function an assignment to its name.
///
/// shape   text: a module as the library's are written: ranges end in ":0", an array is read and written whole or by
///         element, names of arrays and types are a module's only ones; typedef logic [signed] [range] name;
/// error   std::logic_error for a slice of elements, which is not written here
std::string lowered(std::string text);

}  // namespace mote::hardware
