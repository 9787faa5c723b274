#pragma once
// Texts of the page that are files of this room (mote/report/page/), compiled in by embed.cmake.

#include <string>
#include <string_view>

namespace mote::report {

std::string_view style_text();   // style.css
std::string_view guard_text();   // guard.js: shows any script error to the reader
std::string_view script_text();  // the bundled plots; empty if they were not built in

/// `text` with & < > " ' replaced, so that it is text between tags and inside a quoted attribute.
std::string escaped(std::string_view text);

/// Bytes as text of 64 letters, three bytes in four of them, filled up with "=" (RFC 4648, 4).
std::string base64(std::string_view bytes);

}  // namespace mote::report
