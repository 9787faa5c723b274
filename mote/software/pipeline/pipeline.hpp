#pragma once
/// The pipeline: the stages of a step side by side, blocks of particles passing from one to the next.
///
///   dealt in order -> [at most Rp propose] -> queue -> [at most Rw weigh] -> queues -> [a line of chains each takes in
///   its order]

#include <memory>

#include "mote/engine/stage_record.hpp"
#include "mote/filter/stages.hpp"

namespace mote {

/// How a pipeline is manned.
struct PipelineSize {
  std::size_t proposers = 1;  ///< Rp, blocks being proposed at once, at most; up to 64
  std::size_t weighers = 1;   ///< Rw, likewise
  std::size_t chains = 1;     ///< lines of chains that take side by side, up to 64
  std::size_t threads = 1;    ///< that do all of it, the caller's among them
  std::size_t block = 0;      ///< particles that pass together, a power of two up to 1024; 0 = chosen by their number
  /// Seconds that a stage takes for a particle at least: it waits when it has worked for less. For measuring the
  /// pipeline itself by stages of known cost, which need no core. What a wait was too long is taken off the worker's
  /// next.
  struct Pace {
    double propose = 0, weigh = 0, chain = 0;
  } pace = {};
};

/// Particles in a block for `count` of them: sixteen blocks or more for each worker of the broader stage, as far as
/// these have 16 to 1024 particles.
std::size_t block_for(std::size_t count, std::size_t workers);

/// Runs the stages on threads of its own, which stay between steps. A thread takes up what is furthest down the line:
/// chains before weights before proposals; where there is a thread for every worker, it keeps to its stage. At most 4
/// (Rp + Rw + P) blocks are under way at once, so that queues are bounded and what is weighed is still in the caches.
///
/// error   what a stage throws, after the rest has been passed over: of several one
/// cost    some 0.5 us a block; a step that comes within 100 us finds the threads awake
/// source  docs/pipeline.md; IMH-OPT section V-B
class Pipeline final : public StageRunner {
 public:
  explicit Pipeline(const PipelineSize& size);
  ~Pipeline() override;
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  void run(const Stages& stages) override;
  std::size_t proposers() const override;
  std::size_t lines() const override;

  /// Work of one thread alone, which the stages wait for, as the timeline and the record show it.
  class Alone {
   public:
    explicit Alone(Pipeline& pipeline);
    ~Alone();
    Alone(const Alone&) = delete;
    Alone& operator=(const Alone&) = delete;

   private:
    Pipeline* pipeline_;
    double begin_, in_stages_;
  };
  /// The timeline comes to the next step.
  void begin_step(Step t);
  StageRecord record() const;

 private:
  class Floor;
  std::unique_ptr<Floor> floor_;
};

}  // namespace mote
