#include "mote/app/commands/particle_list.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/filter/particles.hpp"

namespace mote {

std::vector<long long> integer_list_from(const Arguments& arguments, const std::string& option, long long least,
                                         long long most, const std::string& example) {
  std::vector<long long> all;
  const std::string text = arguments.text(option);
  for (const std::string_view part : parts_of(text, ',')) {
    const auto n = integer_in(part);
    if (!n || *n < least || *n > most)
      throw Refusal(ExitCode::kWrongUse,
                    {arguments.where(), option, fmt::format("integers from {} to {}, separated by commas", least, most),
                     "\"" + text + "\"", "Pass " + option + " " + example + "."});
    all.push_back(*n);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<std::size_t> particle_list_from(const Arguments& arguments) {
  const auto all =
      integer_list_from(arguments, "--particles", 1, static_cast<long long>(kMostParticles), "100,1000,10000");
  return {all.begin(), all.end()};
}

}  // namespace mote
