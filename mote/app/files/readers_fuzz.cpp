// Fuzzes the readers of data: any bytes end in a recording, a truth or a refusal – never in a crash.

#include <cstddef>
#include <cstdint>
#include <string>

#include "mote/app/files/recording_file.hpp"
#include "mote/base/refusal.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/local_level.hpp"

namespace {

template <class Read>
void attempt(Read&& read) {
  try {
    read();
  } catch (const mote::Refusal&) {  // what bad input is meant to give
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  attempt(
      [&] { mote::recording_from(mote::parse_table("fuzz.csv", text), mote::LocalLevel{}.columns(), "local-level"); });
  attempt([&] { mote::recording_from(mote::parse_table("fuzz.csv", text), mote::Bearings{}.columns(), "bearings"); });
  attempt([&] { mote::truth_from(mote::parse_table("fuzz.csv", text), mote::Bearings{}.states()); });
  return 0;
}
