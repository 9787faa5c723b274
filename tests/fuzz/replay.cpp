// Feeds a fuzz program its seeds without libFuzzer: each as it is, cut off at every byte, and with every byte changed.
// What a fuzzer would find in its first second is found by every check, by any compiler and under the sanitizers.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::size_t fed = 0;

void feed(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  ++fed;
}

void feed_broken(const std::string& seed) {
  constexpr std::array<char, 8> kChanged{'\0', '\xff', ',', '\n', '-', '9', 'e', '"'};
  feed(seed);
  for (std::size_t i = 0; i < seed.size(); ++i) {
    feed(seed.substr(0, i));
    feed(seed.substr(0, i) + seed.substr(i + 1));
    for (const char c : kChanged) {
      std::string changed = seed;
      changed[i] = c;
      feed(changed);
    }
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  for (const auto& entry : std::filesystem::directory_iterator(words[1])) {
    std::ifstream file(entry.path(), std::ios::binary);
    feed_broken({std::istreambuf_iterator<char>(file), {}});
  }
  std::printf("%zu inputs\n", fed);
  return fed == 0 ? 1 : 0;
}
