#pragma once
/// The filters that a circuit can be: an entry each, from which the top module, its simulation and the program know it.

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mote/hardware/circuit.hpp"
#include "mote/hardware/filters/estimate.hpp"
#include "mote/hardware/filters/imh.hpp"
#include "mote/hardware/filters/sisr.hpp"

namespace mote::hardware {

/// What a run is told; a filter takes what it has a register for.
struct RunRegisters : ImhRegisters {
  std::uint32_t exchange = 0;  ///< M, particles that each group hands on
};

/// A register of a filter, written before a run starts.
struct Register {
  std::string_view name;     ///< of its port, without _i
  std::string_view meaning;  ///< with its range
  bool flag = false;         ///< one bit; else a count of up to 2^At
  std::uint32_t (*value)(const RunRegisters&) = nullptr;
};

/// How a filter is built where its kind has a choice.
struct Variant {
  Resampler resampler = Resampler::kSystematic;
  PlainLoops loops = {};      ///< of the filter in separate loops
  bool overlapped = false;    ///< a step of chains begins while the one before is still decided on
  bool logic_tables = false;  ///< tables in look-up tables of the device instead of blocks of memory
};

/// How large a circuit is made: what its registers may be told at most.
struct Capacity {
  unsigned at = 10;           ///< counts go up to 2^at
  std::uint32_t most = 1024;  ///< particles; a power of two
  unsigned lanes = 1;         ///< side by side, each with its own part of the particles
  Variant variant = {};

  unsigned slot_bits() const { return static_cast<unsigned>(ceil_log2(std::max(2U, most / lanes))); }
};

/// A filter's golden model, whatever its kind.
class Golden {
 public:
  virtual ~Golden() = default;
  virtual void start(const RunRegisters& registers) = 0;
  virtual Estimate step(Observed observed) = 0;
  /// What a step wrote to the particle memory.
  virtual const Particles& set() const = 0;
  /// Cycles from start_i to the last estimate, with streams that never wait.
  virtual std::uint64_t cycles() const = 0;
};

/// A kind of filter.
struct Architecture {
  std::string_view name, meaning;
  std::string_view module;                                ///< of the library
  std::string_view golden_file;                           ///< where its golden model stands
  std::vector<Register> registers;                        ///< beside start, steps and busy
  unsigned most_lanes = 1;                                ///< as many as --lanes says, a power of two
  bool chain = false;                                     ///< a chain decides; estimates say how often it moved
  unsigned stages = 0;                                    ///< of its pipeline with one lane, beside the model's
  std::vector<Parameter> (*parameters)(const Capacity&);  ///< that other kinds do not have
  std::string (*range)(const Capacity&);                  ///< of its registers, for the data sheet
  Capacity (*capacity)(const RunRegisters& most, unsigned lanes);
  std::unique_ptr<Golden> (*golden)(const Arithmetic&, std::uint64_t seed, const Capacity&);
  bool folded = false;             ///< one chain before all lanes
  bool pairs = false;              ///< weighs pairs of state and parent, so that any proposal will do
  bool schemes = false;            ///< resamples by any scheme of Resampler
  bool loops = false;              ///< in loops that can be pipelined and merged
  std::string_view c_filter = {};  ///< its golden model in C: a file of machine/golden
  bool turns = false;              ///< may take a particle every few cycles, so that operators take turns

  /// How its chains are fed.
  ImhLanes fed(const Capacity& c) const { return {c.lanes, Parents::kBanked, folded, c.variant.overlapped}; }
  /// Proposals of a step, of all lanes.
  std::uint64_t offered(const RunRegisters& r, const Capacity& c) const {
    return chain ? std::uint64_t{c.lanes} * fed(c).rows(r) : r.particles;
  }
  /// Of those, the proposals that chains may refuse: all but each one's first.
  std::uint64_t decided(const RunRegisters& r, const Capacity& c) const { return offered(r, c) - fed(c).chains(); }
};

/// All kinds, the simplest first.
const std::vector<Architecture>& architectures();

}  // namespace mote::hardware
