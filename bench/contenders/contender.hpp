#pragma once
/// Contenders: bootstrap filters of the growth model that owe nothing to mote, to measure mote against.
///
///   x_0 ~ N(0, 5),   x_t = x_{t-1} / 2 + 25 x_{t-1} / (1 + x_{t-1}^2) + 8 cos(1.2 (t - 1)) + N(0, 10),
///   y_t = x_t^2 / 20 + N(0, 1),   t = 1..T
///
/// systematic resampling at every step, the posterior mean of every step as answer. This header defines no function:
/// files compiled for other instruction sets include it.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace mote::contenders {

/// One of them, with its memory.
class Contender {
 public:
  Contender() = default;
  Contender(const Contender&) = delete;
  Contender(Contender&&) = delete;
  Contender& operator=(const Contender&) = delete;
  Contender& operator=(Contender&&) = delete;
  virtual ~Contender();

  /// Makes room for that many particles, seeds the generators and draws the prior; not timed. Memory is kept from call
  /// to call.
  ///
  /// shape   particles >= 1
  virtual void prepare(std::size_t particles, std::uint64_t seed) = 0;
  /// Filters a recording: means[t - 1] estimates E(x_t | y_{1:t}). Every run follows a prepare() of its own.
  ///
  /// shape   observations, means: (T,)
  /// error   std::runtime_error when a program outside fails
  /// cost    O(N T)
  virtual void run(std::span<const double> observations, std::span<double> means) = 0;
  /// Seconds of the last run where it was not this thread that worked: a program outside times itself. NaN: this
  /// thread.
  virtual double outside_seconds() const;
  /// Bytes that a program outside took for the last run; NaN: this program's memory.
  virtual double outside_bytes() const;
};

/// What is known of a contender before it runs.
struct Description {
  std::string_view name;
  std::string_view meaning;
  /// Bytes that a particle-step reads and writes at least once the particles outgrow the caches; derived from the
  /// passes over arrays of N numbers, which the contender's file lists.
  double bytes_per_particle_step;
  /// An empty text, or the sentence that says why it cannot run on this machine.
  std::string (*why_not)();
  std::unique_ptr<Contender> (*make)();
};

/// What a user writes: one loop a step, std::mt19937_64, double.
extern const Description kBaseline;
/// numpy in a process of its own, double.
extern const Description kNumpy;
/// Fused by hand for AVX-512, states and weights in float.
extern const Description kLimitFloat;
/// The same with states in double; noise and weights keep float's resolution.
extern const Description kLimitDouble;

}  // namespace mote::contenders
