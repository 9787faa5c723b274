#include "mote/hardware/lookup.hpp"

namespace mote::hardware {
namespace {

std::vector<Word> values(const std::function<double(double)>& function, const Format& x, const Format& y) {
  std::vector<Word> table;
  for (Word word = 0; word <= x.greatest(); ++word) table.push_back(y.nearest(function(x.value(word))));
  for (Word word = x.least(); word < 0; ++word) table.push_back(y.nearest(function(x.value(word))));
  return table;
}

}  // namespace

Lookup::Lookup(const std::function<double(double)>& function, const Format& x, const Format& y)
    : Lookup(x, y, values(function, x, y)) {}

Lookup::Lookup(const Format& x, const Format& y, std::vector<Word> table) : x_(x), y_(y), table_(std::move(table)) {}

Lookup Lookup::in_logic() const {
  Lookup same = *this;
  same.logic_ = true;
  return same;
}

Memory Lookup::memory() const {
  const std::uint64_t kept = ~std::uint64_t{0} >> (64 - y_.width());
  Memory memory{"File", y_.width(), {}};
  for (const Word word : table_) memory.words.push_back(static_cast<std::uint64_t>(word) & kept);
  return memory;
}

Circuit Lookup::circuit() const {
  std::vector<Parameter> parameters{parameter("AddressWidth", x_.width()), parameter("Width", y_.width()),
                                    parameter("OutRegister", large())};
  if (large() && logic_) parameters.push_back(parameter("Logic", true));
  return {"mote_rom",
          std::move(parameters),
          {port("address_i", x_)},
          {port("word_o", y_)},
          large() ? 2 : 1,
          false,
          {memory()},
          {},
          memory_bits() < kSharedFrom ? Sharing::kNever : Sharing::kAlike};
}

Circuit LookupPair::circuit() const {
  const Format& x = table.x();
  const Format& y = table.y();
  return {"mote_rom_pair",
          {parameter("AddressWidth", x.width()), parameter("Width", y.width())},
          {port("address0_i", x), port("address1_i", x)},
          {port("word0_o", y), port("word1_o", y)},
          2,
          false,
          {table.memory()},
          {},
          Sharing::kAlike};
}

}  // namespace mote::hardware
