#include "mote/app/terminal/ranks.hpp"

#include <cstdlib>
#include <ctime>
#include <sstream>
#include <string>

namespace mote {
namespace {

/// Whether this is the first process of its command line, of which mpirun may be given several.
bool is_first() {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  if (rank == nullptr) return true;
  const char* const known = std::getenv("OMPI_FIRST_RANKS");
  std::istringstream first_ranks(known == nullptr ? "0" : known);
  for (std::string first; first_ranks >> first;)
    if (first == rank) return true;
  return false;
}

}  // namespace

bool speaks_for_job(std::chrono::milliseconds patience) {
  if (is_first()) return true;
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(patience);
  const timespec time{whole.count(), std::chrono::nanoseconds(patience - whole).count()};
  return nanosleep(&time, nullptr) == 0;
}

}  // namespace mote
