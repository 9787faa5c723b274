// Fuzzes the reader of matrices: any TOML or JSON ends in matrices or a refusal.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "mote/app/files/matrices.hpp"
#include "mote/base/refusal.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const std::string path : {"fuzz.toml", "fuzz.json"}) {
    try {
      mote::LinearGaussian(mote::parse_linear_gaussian(path, text));
    } catch (const mote::Refusal&) {          // what bad input is meant to give
    } catch (const std::invalid_argument&) {  // matrices that do not fit together
    }
  }
  return 0;
}
