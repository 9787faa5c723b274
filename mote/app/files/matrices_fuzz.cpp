// Fuzzes the reader of matrices: any TOML or JSON ends in matrices or a refusal.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include "mote/app/files/matrices.hpp"
#include "mote/base/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const std::string ending : {".toml", ".json"}) {
    const std::string path = "/tmp/mote-fuzz-matrices" + ending;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) return 0;
    std::fwrite(data, 1, size, file);
    std::fclose(file);
    try {
      mote::read_linear_gaussian(path);
    } catch (const mote::Refusal&) {  // what bad input is meant to give
    }
  }
  return 0;
}
