/// Any bytes as the file of a model: it is refused, or it is a model that can be computed.

#include <cstdint>

#include "mote/graph/text/text_model.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mote;
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const char c : text)
    if (static_cast<unsigned char>(c) > 127) return 0;  // refused before it is parsed
  try {
    const graph::TextFile file = graph::parse_text_file("m.toml", text);
    std::vector<double> parameters;
    for (const graph::NamedNumber& p : file.parameters) parameters.push_back(p.value);
    const graph::TextModel model(file, parameters);
    auto block = Draws{1, 0}.block(Purpose::kTest);
    auto draw = block.particle(0);
    const auto before = model.initial<double>(draw);
    const auto x = model.next<double>(1, before, draw);
    if (!(model.log_likelihood<double>(1, x, blank_row(model)) == 0)) __builtin_trap();
  } catch (const Refusal&) {
  }
  return 0;
}
