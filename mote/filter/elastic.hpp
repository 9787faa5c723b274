#pragma once
/// Elastic: a filter whose number of particles may change from step to step.

#include <cstddef>

namespace mote {

/// The face of such a filter beside Filter. Draws are addressed by particle, so those that stay the same particles keep
/// their draws, and a run whose numbers are told again is the same run.
class Elastic {
 public:
  virtual ~Elastic() = default;

  /// Has the filter go on with so many particles: SISR from its next selection on, which leaves them; chains from their
  /// next proposals on, of which they draw and keep so many.
  ///
  /// shape   1 to kMostParticles; chains: at least one a chain
  virtual void aim(std::size_t particles) = 0;
  /// Particles, or proposals, that the last step weighed; to be asked before select().
  virtual std::size_t weighed() const = 0;

 protected:
  Elastic() = default;
  Elastic(const Elastic&) = default;
  Elastic(Elastic&&) = default;
  Elastic& operator=(const Elastic&) = default;
  Elastic& operator=(Elastic&&) = default;
};

}  // namespace mote
