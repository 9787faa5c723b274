#include "mote/app/commands/particle_list.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/filter/particles.hpp"

namespace mote {

std::vector<std::size_t> particle_list_from(const Arguments& arguments) {
  std::vector<std::size_t> all;
  std::istringstream stream(arguments.text("--particles"));
  for (std::string part; std::getline(stream, part, ',');) {
    const auto n = integer_in(std::string(trimmed(part)));
    if (!n || *n < 1 || *n > static_cast<long long>(kMostParticles))
      throw Refusal(
          ExitCode::kWrongUse,
          {arguments.where(), "--particles", fmt::format("integers from 1 to {}, separated by commas", kMostParticles),
           "\"" + arguments.text("--particles") + "\"", "Pass --particles 100,1000,10000."});
    all.push_back(static_cast<std::size_t>(*n));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace mote
