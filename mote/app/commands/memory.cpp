#include "mote/app/commands/memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

#include "mote/base/numbers.hpp"

namespace mote {
namespace {

double of_machine() {
  std::ifstream info("/proc/meminfo");
  std::string key;
  std::string unit;
  double kilobytes = 0;
  while (info >> key >> kilobytes >> unit)
    if (key == "MemAvailable:") return kilobytes * 1024;
  return kInfinity;
}

/// The limit at the root of the control groups that the program sees, of either version; "max" reads as none.
double of_container() {
  for (const char* path : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream file(path);
    double bytes = 0;
    if (file >> bytes) return bytes;
  }
  return kInfinity;
}

double of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kInfinity;
  std::ifstream pages("/proc/self/statm");
  double used = 0;
  pages >> used;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used * static_cast<double>(sysconf(_SC_PAGESIZE)));
}

}  // namespace

double available_memory() { return std::min({of_machine(), of_container(), of_address_space()}); }

}  // namespace mote
