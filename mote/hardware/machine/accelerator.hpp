#pragma once
/// Parts of a filter by themselves, between AXI4-Streams: normal numbers, a model's log likelihood, a resampler.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mote/hardware/machine/machine.hpp"
#include "mote/hardware/machine/model_circuit.hpp"

namespace mote::hardware {

/// A stream's word.
struct Beat {
  std::vector<std::int64_t> fields;
  bool last = false;
};

/// A stream of an accelerator: ports <name>_tdata, _tvalid, _tready, _tlast.
struct Stream {
  std::string name;
  std::vector<Field> fields;  ///< of a word, from bit 0 on
  bool last = false;          ///< it has tlast

  int field_bits() const;
  int bits() const;  ///< of tdata: whole bytes
};

/// A circuit of its own with its golden model.
///
/// golden   what comes out when these words come in, stream by stream; from the state after a reset, at most `words`
struct Accelerator {
  std::string name, meaning, timing;
  std::vector<Stream> in;
  Stream out;
  std::vector<std::pair<Port, std::uint32_t>> registers;  ///< that stand, and what they are held to in a simulation
  std::function<std::vector<Beat>(const std::vector<std::vector<Beat>>& in, std::size_t words)> golden;
  struct Part {
    std::string instance;
    Circuit circuit;
    ModelCircuit::Connections connections;  ///< none where the template has them
  };
  std::vector<Part> parts;                    ///< whose tables and generated modules it needs
  std::string source;                         ///< a template of machine/templates
  std::map<std::string, std::string> places;  ///< of the template, but those that all have

  /// Modules, its own last, seeking tables in a folder (empty, or with its closing slash).
  std::vector<DesignFile> modules(const std::string& folder) const;
  std::vector<DesignFile> tables() const;
  /// Pins that all ports together take.
  int pins() const;
  /// What the bits of its streams are: lines of a data sheet.
  std::string sheet() const;
};

/// Vectors of normal numbers of mean 0 by the method of Box and Muller with CORDIC, one a clock:
///
///   x = L z,  L L' = C
///
/// shape   covariance: D rows of D, symmetric; words of 18 bits whose point the greatest deviation sets
/// error   below 2 D steps of a word in x; |z| <= 6.8. Refusal (kWrongUse) for a matrix that is not positive definite
/// source  PPF section 3.5; Box & Muller 1958
Accelerator gaussian_accelerator(const std::vector<std::vector<double>>& covariance, std::uint64_t seed);

/// log2 p(y | x) of a model: an observation word comes in, then states, the last with tlast; their log weights go out.
Accelerator likelihood_accelerator(const ModelCircuit& model);

/// Systematic resampling of sets of n particles, at most `most`: log weights come in, parents go out.
Accelerator resampler_accelerator(std::uint32_t most, std::uint32_t n, std::uint64_t seed);

/// The parents of a set by systematic resampling, as mote_resample finds them.
///
/// shape   log_weights: (N), octaves with 10 fraction bits; uniform: v 2^24
std::vector<std::uint32_t> resampled(const std::vector<std::int64_t>& log_weights, const Formats& formats,
                                     std::uint32_t uniform);

}  // namespace mote::hardware
