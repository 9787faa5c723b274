#pragma once
/// Whole text files, and numbers in text.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

/// The bytes of a file.
///
/// error   Refusal (kBadData) when it is missing, a folder, unreadable or holds a byte 0; Refusal (kInterrupted) when a
///         signal ends the wait for a pipe
std::string read_text(const std::string& path);

/// Refuses a text with a byte above 127: the TOML library's tables of letters have holes that it may fall into.
///
/// error   Refusal (kBadData) naming file:line
void refuse_other_than_ascii(const std::string& path, std::string_view text);

/// A text as one line that a terminal may be trusted with: "?" for control characters (a file may be called anything).
std::string printable(std::string text);

/// A text as a message shows it: in quotes, not too long, without control characters.
std::string in_quotes(std::string_view text);

/// The number that a text is, whole; "nan" gives NaN. Nothing when it is no number.
std::optional<double> number_in(std::string_view text);

/// The integer that a text is, whole.
std::optional<long long> integer_in(std::string_view text);

/// The text without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// The parts of a text between separators, each without blanks at its ends; one for a text without any.
std::vector<std::string_view> parts_of(std::string_view text, char separator);

}  // namespace mote
