// What a user writes in an afternoon: clear loops, the standard library's generator, double.
//
// Passes over N doubles: propagate reads x, writes x and w; weigh reads w and x, writes w; resample reads w and x,
// writes the children: 9 x 8 bytes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "bench/contenders/contender.hpp"

namespace mote::contenders {
namespace {

class Baseline final : public Contender {
 public:
  void prepare(std::size_t particles, std::uint64_t seed) override {
    states_.resize(particles);
    weights_.resize(particles);
    children_.resize(particles);
    generator_.seed(seed);
    normal_.reset();
    for (double& x : states_) x = std::sqrt(5.0) * normal_(generator_);
  }

  void run(std::span<const double> observations, std::span<double> means) override {
    for (std::size_t t = 0; t < observations.size(); ++t) {
      const double largest = propagate(8 * std::cos(1.2 * static_cast<double>(t)), observations[t]);
      const double total = weigh(largest, means[t]);
      resample(total);
    }
  }

 private:
  /// Moves every particle, leaves its log weight; returns the largest.
  double propagate(double push, double observation) {
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const double before = states_[i];
      const double x = before / 2 + 25 * before / (1 + before * before) + push + std::sqrt(10.0) * normal_(generator_);
      const double error = observation - x * x / 20;
      states_[i] = x;
      weights_[i] = -0.5 * error * error;
      largest = std::max(largest, weights_[i]);
    }
    return largest;
  }

  /// Weights from their logarithms; returns their sum.
  double weigh(double largest, double& mean) {
    double total = 0;
    double moment = 0;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      weights_[i] = std::exp(weights_[i] - largest);
      total += weights_[i];
      moment += weights_[i] * states_[i];
    }
    mean = moment / total;
    return total;
  }

  void resample(double total) {
    const double stride = total / static_cast<double>(states_.size());
    double target = std::uniform_real_distribution<double>()(generator_) * stride;
    double through = weights_[0];
    std::size_t parent = 0;
    for (double& child : children_) {
      while (through < target && parent + 1 < states_.size()) through += weights_[++parent];
      child = states_[parent];
      target += stride;
    }
    states_.swap(children_);
  }

  std::vector<double> states_, weights_, children_;
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace

const Description kBaseline{"baseline", "loops as a user writes them, mt19937_64, double", 72,
                            [] { return std::string(); },
                            []() -> std::unique_ptr<Contender> { return std::make_unique<Baseline>(); }};

}  // namespace mote::contenders
