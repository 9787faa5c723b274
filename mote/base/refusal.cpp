#include "mote/base/refusal.hpp"

namespace mote {
namespace {

std::string sentence(const RefusalText& text) {
  std::string line = text.where;
  if (!text.what.empty()) line += (line.empty() ? "" : ": ") + text.what;
  if (!text.expected.empty()) line += ": expected " + text.expected;
  if (!text.got.empty()) line += ", got " + text.got;
  line += '.';
  if (!text.next_step.empty()) line += ' ' + text.next_step;
  return line;
}

}  // namespace

Refusal::Refusal(ExitCode code, const RefusalText& text) : std::runtime_error(sentence(text)), code_(code) {}
Refusal::Refusal(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}

}  // namespace mote
