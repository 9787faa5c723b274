#include "mote/hardware/filters/weights.hpp"

#include <bit>
#include <cmath>
#include <fstream>

#include "mote/base/refusal.hpp"

namespace mote::hardware {
namespace {

template <class Table>
Table filled(double (*entry)(double)) {
  Table table{};
  for (std::size_t k = 0; k < table.size(); ++k)
    table[k] = static_cast<typename Table::value_type>(std::lround(entry(static_cast<double>(k))));
  return table;
}

template <class Table>
void write(const std::filesystem::path& file, const Table& table) {
  std::ofstream out(file);
  out << std::hex;
  for (const auto entry : table) out << static_cast<unsigned>(entry) << '\n';
  out.close();
  if (!out) throw Refusal(ExitCode::kCannotWrite, {file.string(), "", "a file to write a table to", "an error", ""});
}

}  // namespace

const std::array<std::uint16_t, 1024>& exp2_table() {
  static const auto table =
      filled<std::array<std::uint16_t, 1024>>([](double k) { return std::ldexp(std::exp2(k / 1024), 15); });
  return table;
}

const std::array<std::uint8_t, 128>& log2_table() {
  static const auto table = filled<std::array<std::uint8_t, 128>>([](double k) {
    const double m = (k + 0.5) / 128;
    return 1024 * (std::log2(1 + m) - m);
  });
  return table;
}

void write_tables(const std::filesystem::path& folder) {
  write(folder / "exp2.hex", exp2_table());
  write(folder / "log2.hex", log2_table());
}

std::int64_t log_drop(std::uint32_t word) {
  const auto zeros = static_cast<unsigned>(std::countl_zero(word));
  const std::uint32_t leading = word == 0 ? 0 : word << zeros;
  const std::uint32_t mantissa = (leading >> 21) & 1023;
  return ((zeros + 1) << kLogFraction) - static_cast<std::int64_t>(mantissa + log2_table()[mantissa >> 3]);
}

}  // namespace mote::hardware
