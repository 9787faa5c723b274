#include "mote/referee/solver.hpp"

#include "mote/referee/grid.hpp"
#include "mote/referee/kalman.hpp"

namespace mote::referee {
namespace {

template <class M>
class KalmanSolver final : public Solver {
 public:
  explicit KalmanSolver(M model) : model_(std::move(model)) {}

  std::string_view name() const override { return "Kalman filter"; }
  std::optional<Solution> solve(const Recording& recording) override {
    const std::vector<Gaussian> laws = kalman(model_, recording);
    Solution solution{{}, log_evidence(laws)};
    for (const Gaussian& law : laws) solution.means.emplace_back(law.mean.begin(), law.mean.end());
    return solution;
  }

 private:
  M model_;
};

constexpr double kSmallestEdge = 50;
constexpr double kMostPoints = 8001;

/// The largest step that resolves the transition where the drift is steepest (slope 25), the prior, and the likelihood
/// out to x = 50 (dy/dx = x / 10): a Gaussian of 1.2 steps is integrated to 4e-13.
double grid_step(const UngmParameters& p) {
  return std::min({std::sqrt(p.q) / 25, std::sqrt(p.p0), std::sqrt(p.r) / 5}) / 1.2;
}

/// The recording of one of the model's copies.
Recording copy_of(const Recording& recording, std::size_t copy) {
  Recording one{{recording.observations[copy]}, {}};
  for (const ObservedStep& step : recording.steps) {
    ObservedStep& own = one.steps.emplace_back(ObservedStep{step.t, {}});
    for (const Row<double>& row : step.rows) own.rows.push_back({{row[copy]}, {row.seen(copy)}});
  }
  return one;
}

class GridSolver final : public Solver {
 public:
  GridSolver(const UngmParameters& parameters, std::size_t copies) : copies_(copies) {
    for (const double edge : {kSmallestEdge, 2 * kSmallestEdge, 4 * kSmallestEdge})
      grids_.emplace_back(Ungm<1>{parameters}, edge,
                          1 + 2 * static_cast<std::size_t>(std::ceil(edge / grid_step(parameters))));
  }

  std::string_view name() const override { return "grid filter"; }
  std::optional<Solution> solve(const Recording& recording) override {
    Solution solution{std::vector<std::vector<double>>(recording.steps.size()), 0};
    for (std::size_t copy = 0; copy < copies_; ++copy) {
      const auto result = on_a_grid(copy_of(recording, copy));
      if (!result) return std::nullopt;
      for (std::size_t k = 0; k < result->means.size(); ++k) solution.means[k].push_back(result->means[k]);
      solution.log_evidence += result->log_evidence;
    }
    return solution;
  }

 private:
  std::optional<GridResult> on_a_grid(const Recording& recording) {
    for (Grid& grid : grids_)
      if (GridResult result = grid.filter(recording); result.outside < 1e-6 && std::isfinite(result.log_evidence))
        return result;
    return std::nullopt;
  }

  std::size_t copies_;
  std::vector<Grid> grids_;
};

}  // namespace

std::unique_ptr<Solver> solver_of(const LocalLevel& model) { return std::make_unique<KalmanSolver<LocalLevel>>(model); }
std::unique_ptr<Solver> solver_of(const LinearGaussian& model) {
  return std::make_unique<KalmanSolver<LinearGaussian>>(model);
}

std::unique_ptr<Solver> growth_solver(const UngmParameters& parameters, std::size_t copies) {
  if (!(2 * kSmallestEdge / grid_step(parameters) < kMostPoints)) return nullptr;
  return std::make_unique<GridSolver>(parameters, copies);
}

}  // namespace mote::referee
