#pragma once
/// The programs that simulate, synthesise, place and route; and the files that they read and write.

#include <string>
#include <vector>

namespace mote::hardware {

/// Runs a program of a Debian package and gives what it printed on its standard output.
///
/// error   Refusal (kOutsideTool) that names the package when there is no such program, or shows the end of what it
/// said when it fails
std::string run_tool(const std::string& program, const std::string& package, const std::vector<std::string>& words);

/// Is there such a program on PATH?
bool on_path(const std::string& program);

/// error   Refusal (kCannotWrite)
void write_text(const std::string& path, const std::string& text);

/// error   Refusal (kOutsideTool): a tool did not write it
std::string read_text(const std::string& path);

}  // namespace mote::hardware
