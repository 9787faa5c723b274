#include "mote/hardware/filters/weights.hpp"

#include <algorithm>
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

std::int64_t scale_needed(std::int64_t log_weight) { return (log_weight >> (kLogFraction + 3)) + 1; }

std::uint64_t weight_at(std::int64_t log_weight, std::int64_t scale, unsigned weight_bits) {
  const std::uint64_t power = exp2_table()[static_cast<std::size_t>(log_weight & 1023)] | 1U << kMantissaBits;
  const auto fine = static_cast<unsigned>(7 - ((log_weight >> kLogFraction) & 7));
  return lowered(power << (weight_bits - 1 - kMantissaBits), quanta_between(scale_needed(log_weight), scale)) >> fine;
}

}  // namespace

const std::array<std::uint16_t, 1024>& exp2_table() {
  static const auto table = filled<std::array<std::uint16_t, 1024>>(
      [](double k) { return std::ldexp(std::exp2(k / 1024) - 1, kMantissaBits); });
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

void scale_weights(std::span<const std::int64_t> log_weights, std::size_t lanes, unsigned weight_bits,
                   std::span<ScaledWeight> weights) {
  std::int64_t scale = 0;
  for (std::size_t row = 0; row < log_weights.size(); row += lanes) {
    const auto in = log_weights.subspan(row, lanes);
    const std::int64_t needed = scale_needed(*std::max_element(in.begin(), in.end()));
    const std::int64_t risen = row == 0 ? needed : std::max(scale, needed);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      weights[row + lane] = {weight_at(in[lane], risen, weight_bits), 0, risen};
    if (row > 0) weights[row].rise = quanta_between(scale, risen);
    scale = risen;
  }
}

}  // namespace mote::hardware
