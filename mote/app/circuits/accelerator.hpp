#pragma once
/// An accelerator's folder and figures: parts of a filter by themselves, between streams.

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "mote/app/circuits/circuit.hpp"
#include "mote/app/files/output.hpp"
#include "mote/engine/recording.hpp"
#include "mote/hardware/machine/accelerator.hpp"
#include "mote/hardware/machine/cost.hpp"

namespace mote {

/// An accelerator with the words that its testbench plays to it.
struct PlayedAccelerator {
  hardware::Accelerator made;
  std::vector<std::vector<hardware::Beat>> in;
  std::size_t words = 0;  ///< that come out
};

/// 1000 vectors.
PlayedAccelerator played_gaussian(const std::vector<std::vector<double>>& covariance, std::uint64_t seed);
/// A model's recording, with the particles of a circuit's golden model.
PlayedAccelerator played_likelihood(const FilterCircuit& circuit, const CircuitDesign& design,
                                    const Recording& recording, const std::string& where);
/// Sets of n log weights, from all alike to one that is much heavier than the others.
PlayedAccelerator played_resampler(std::uint32_t n, std::uint64_t seed);

/// Figures of one: {lut, ff, dsp, bram18, iob, fmax_mhz, sta_ns, device, power_mw}; null without a cost.
nlohmann::json accelerator_json(const std::optional<hardware::Cost>& cost);
std::string accelerator_text(const hardware::Accelerator& made, const std::optional<hardware::Cost>& cost);

/// Adds its files to the outputs: SystemVerilog, tables, a testbench, a README.
///
/// error   as write_design()
void write_accelerator(OutputSet& outputs, const std::string& folder, const PlayedAccelerator& played,
                       const std::optional<hardware::Cost>& cost, const std::string& command);

}  // namespace mote
