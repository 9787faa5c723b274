#pragma once
/// Targets: what an exploration searches on – a processor, a cluster, a device –, its candidates and what they take.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mote/app/catalogue/scene.hpp"
#include "mote/engine/run_record.hpp"

namespace mote::explore {

/// A candidate: words of a command line.
using Words = std::vector<std::string>;

/// A figure of what candidates take, the better the less it is.
struct Figure {
  std::string name, unit;  ///< "time", "s"
  std::string option;      ///< that limits it; empty: none
  bool axis = true;        ///< of the frontier
  double limit = 0;        ///< that the target itself has; 0: none
};

/// Keeps what took long to find, by its name, from one exploration to the next.
class Memory {
 public:
  virtual ~Memory() = default;
  /// What is kept under the name, or what `find` finds, which is kept then; `values` are as many as there have to be.
  ///
  /// shape   several threads may ask at once; those that ask for the same wait for the first
  /// error   Refusal (kBadData) where as many are not kept
  virtual std::vector<double> recall(const std::string& name, std::size_t values,
                                     const std::function<std::vector<double>()>& find) = 0;
};

/// A piece of work whose findings the memory keeps.
using Piece = std::function<void(Memory& memory)>;

/// A machine of some kind with its candidates.
class Target {
 public:
  virtual ~Target() = default;
  virtual std::string name() const = 0;     ///< as --target says it
  virtual std::string meaning() const = 0;  ///< where its figures come from
  virtual std::vector<Figure> figures() const = 0;
  virtual const std::vector<Words>& candidates() const = 0;
  /// Whether its figures are measured on this machine: one at a time, with nothing else going on.
  virtual bool measures() const = 0;
  /// What candidates have in common, to be found before what each takes: different pieces, the longest first.
  virtual std::vector<Piece> shared_work() const { return {}; }
  /// What a candidate takes, figure by figure.
  ///
  /// error   Refusal (kCollapsed) when all weights were zero
  virtual std::vector<double> takes(std::size_t candidate, Memory& memory) const = 0;
  /// A run of it on a recording; several threads may run at once.
  ///
  /// error   Refusal (kCollapsed) when all weights were zero
  virtual RunRecord run(std::size_t candidate, const Recording& recording, std::uint64_t seed) const = 0;
  /// The command that builds it, or runs it on `data`.
  virtual std::string command(std::size_t candidate, const std::string& data) const = 0;
};

/// What candidates there are: lists of choices, each as told or the target's own.
struct Space {
  std::string model, where;
  std::vector<std::string> settings;  ///< --set
  std::shared_ptr<const CatalogueModel> catalogue_model;
  std::string detail;                  ///< what --target says behind a colon
  std::string platform;                ///< of a simulated cluster
  std::vector<std::string> kinds;      ///< of filters or circuits; empty: all
  std::vector<std::size_t> particles;  ///< empty: the target's
  std::vector<std::size_t> workers;    ///< threads, ranks, or lanes; empty: the target's
  std::vector<int> more_bits;          ///< of words
  std::vector<int> currents, bits;     ///< I_a in nA, and of ADCs; empty: the target's
};

/// A kind of target, as --target names it.
struct TargetKind {
  std::string name;                  ///< "cpu"
  std::string detail;                ///< "DEVICE": what stands behind a colon; empty: nothing does
  std::string example;               ///< "fpga:xc7a100t"
  std::vector<std::string> options;  ///< for candidates, of those that not every target reads
  /// `recording` is what candidates are timed or counted on.
  std::unique_ptr<Target> (*make)(const Space& space, const Recording& recording);
};

/// All kinds of targets: a new one is a line here and a file that makes it.
const std::vector<TargetKind>& target_kinds();

/// Keeps the candidates that `accepts` does not refuse (Refusal, kWrongUse): what a model, a filter or a circuit does
/// not have. `needs` says what a candidate has to have, to whom none is left.
///
/// error   the first refusal when none is left, or Refusal (kWrongUse) when there was none to begin with
std::vector<Words> accepted(const Space& space, const std::vector<Words>& all, const std::string& needs,
                            const std::function<void(const Words&)>& accepts);

/// Kinds that were told, out of those there are, each once, in their order.
///
/// error   Refusal (kWrongUse) for one that there is not
std::vector<std::string> kinds_of(const Space& space, const std::vector<std::string>& all);

/// "--set a=1 --set b=2", with a blank before.
std::string settings_of(const Space& space);

/// Candidate filters on threads of this processor: time by measurement.
std::unique_ptr<Target> processor(const Space& space, const Recording& timed);

/// Candidate filters on ranks of a simulated cluster, with particles timed on a core of this machine.
///
/// error   Refusal (kOutsideTool) without SimGrid, (kWrongUse) for a platform that there is not
std::unique_ptr<Target> cluster(const Space& space, const Recording& unread);

/// Candidate circuits on a device: cycles by the golden models' laws, area and clock by synthesis of their parts, power
/// by hardware::power_mw().
///
/// error   Refusal (kWrongUse) for a device that there is not, or a model that is no arithmetic
std::unique_ptr<Target> device(const Space& space, const Recording& counted);

/// Candidate filters with analog parts: methods, kinds of filter, currents, bits of converters, copies of the circuits.
///
/// error   Refusal (kOutsideTool) without ngspice, (kWrongUse) for a model that is no arithmetic
std::unique_ptr<Target> mixed_mode(const Space& space, const Recording& unread);

}  // namespace mote::explore
