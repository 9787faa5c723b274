#include "mote/analog/power.hpp"

namespace mote::analog {
namespace {

/// alpha C_L of one bit of a stage's three words, in farad: 550 uW / (3 12^2 (3.3 V)^2 1 MHz).
constexpr double kBitFarad = 550e-6 / (3 * 144 * 3.3 * 3.3 * 1e6);

}  // namespace

double cordic_power(const Process& process, int bits, double clock_hz) {
  const double farad = 3 * kBitFarad * bits * bits * (process.node_um / 0.35);
  return farad * process.vdd_v * process.vdd_v * clock_hz;
}

double mcml_power() { return 4330e-6; }

double adder_power(double clock_hz) { return 0.21e-3 * clock_hz / 2e6; }

double digital_mac_power(double clock_hz) { return 17 * adder_power(clock_hz); }

double printed_arctan_power(double ia_a) { return 14.45e-6 * ia_a / 20e-9; }

double printed_gaussian_power(double ia_a) { return 109.7e-6 * ia_a / 10e-9; }

double random_words_power(int words, double clock_hz) { return 2 * words * adder_power(clock_hz); }

}  // namespace mote::analog
