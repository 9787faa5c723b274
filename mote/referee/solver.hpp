#pragma once
/// Exact solutions behind one face: whoever has a model asks for its solver, and gets none where none is known.

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "mote/engine/recording.hpp"
#include "mote/model/linear_gaussian.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"

namespace mote::referee {

/// What is known exactly of a recording: the posterior means that a filter's estimates approach as N grows.
struct Solution {
  std::vector<std::vector<double>> means;  ///< (T, D), E(x_t | y_{1:t}) at the recording's steps
  double log_evidence;                     ///< log p(y_{1:T}), nat
};

/// Solves recordings of one model; keeps what they share. Not thread-safe.
class Solver {
 public:
  virtual ~Solver() = default;
  /// "Kalman filter"
  virtual std::string_view name() const = 0;
  /// The exact solution; nothing where the method does not reach (a state that leaves every grid).
  virtual std::optional<Solution> solve(const Recording& recording) = 0;

 protected:
  Solver() = default;
  Solver(const Solver&) = default;
  Solver(Solver&&) = default;
  Solver& operator=(const Solver&) = default;
  Solver& operator=(Solver&&) = default;
};

/// The solver of a model; nullptr: none is known.
template <Model M>
std::unique_ptr<Solver> solver_of(const M&) {
  return nullptr;
}

/// Linear Gaussian models: the Kalman filter.
///
/// cost    O(n^3 + m^3) a row
/// source  kalman.hpp
std::unique_ptr<Solver> solver_of(const LocalLevel& model);
std::unique_ptr<Solver> solver_of(const LinearGaussian& model);

/// The growth model: a grid for each copy, its step fine enough for q, r and p0, its edge at 50, 100 or 200, whichever
/// first holds all but 1e-6 of the probability; nullptr where that would take more than 8001 points to an edge of 50.
///
/// cost    0.4 million products a step and copy at the defaults
/// source  grid.hpp
std::unique_ptr<Solver> growth_solver(const UngmParameters& parameters, std::size_t copies);

template <std::size_t Copies>
std::unique_ptr<Solver> solver_of(const Ungm<Copies>& model) {
  return growth_solver(model.p, Copies);
}

}  // namespace mote::referee
