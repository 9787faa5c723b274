#include "mote/design/geometric.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <Eigen/Dense>
#include <nlopt.hpp>

#include "mote/base/numbers.hpp"

namespace mote::design {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double kFarthest = 60;  // |log x|: twenty-six decades
constexpr double kSlack = 1e-9;   // of a limit, in log coordinates
constexpr double kNear = 0.01;    // a limit so near may hold the optimum

/// A convex function at a point: value, gradient, Hessian.
struct Convex {
  double value = 0;
  Vector gradient;
  Matrix hessian;
};

/// log of a posynomial at x = exp(r):  m + log sum_k exp(l_k - m),  l_k = log c_k + a_k r.  Its gradient is the mean of
/// the powers a_k, weighted by the terms, its Hessian their covariance.
Convex log_of(const Posynomial& sum, const Vector& r) {
  const auto terms = static_cast<Eigen::Index>(sum.size());
  Vector logs(terms);
  Matrix powers(terms, r.size());
  for (Eigen::Index k = 0; k < terms; ++k) {
    const Monomial& term = sum[static_cast<std::size_t>(k)];
    powers.row(k) = Eigen::Map<const Vector>(term.powers.data(), r.size());
    logs[k] = std::log(term.coefficient) + powers.row(k) * r;
  }
  const double largest = logs.maxCoeff();
  const Vector shares = (logs.array() - largest).exp();
  const double total = shares.sum();
  const Vector weights = shares / total;
  Convex f{largest + std::log(total), powers.transpose() * weights, {}};
  f.hessian = powers.transpose() * weights.asDiagonal() * powers - f.gradient * f.gradient.transpose();
  return f;
}

double worst_limit(const GeometricProgram& program, const Vector& r) {
  double worst = -kInfinity;
  for (const Posynomial& limit : program.limits) worst = std::max(worst, log_of(limit, r).value);
  return worst;
}

/// The central path of   min f(z)   where   limits(z) < 0,  from a z inside: Newton's method on  t f - sum_i
/// log(-limit_i), t twentyfold from one minimum to the next, up to a gap of m / t.
///
/// source  Boyd & Vandenberghe 2004, sec. 11.3
class CentralPath {
 public:
  using Functions = std::function<std::vector<Convex>(const Vector&)>;  // f, then the limits

  explicit CentralPath(Functions functions) : functions_(std::move(functions)) {}

  /// `enough` may end it early.
  void follow(Vector& z, const std::function<bool(const Vector&)>& enough) const {
    constexpr double kLast = 1e10;  // a gap of 1e-9; beyond it rounding
    for (double t = 1; t < kLast && !enough(z); t *= 20)
      for (int step = 0; step < 100; ++step)
        if (!newton(z, t)) break;
  }

 private:
  double barrier(const std::vector<Convex>& at, double t) const {
    double value = t * at[0].value;
    for (std::size_t i = 1; i < at.size(); ++i) value += at[i].value < 0 ? -std::log(-at[i].value) : kInfinity;
    return value;
  }

  /// One step; false at the minimum.
  bool newton(Vector& z, double t) const {
    const std::vector<Convex> at = functions_(z);
    Vector g = t * at[0].gradient;
    Matrix h = t * at[0].hessian;
    for (std::size_t i = 1; i < at.size(); ++i) {
      const double u = -1 / at[i].value;
      g += u * at[i].gradient;
      h += u * at[i].hessian + u * u * at[i].gradient * at[i].gradient.transpose();
    }
    h.diagonal().array() += 1e-12 * (1 + h.diagonal().maxCoeff());
    const Vector step = h.ldlt().solve(-g);
    const double slope = g.dot(step);
    if (!(slope < -1e-4)) return false;
    const double before = barrier(at, t);
    for (double length = 1; length > 1e-6; length /= 2) {
      const Vector next = z + length * step;
      if (!(barrier(functions_(next), t) <= before + 0.1 * length * slope)) continue;
      z = next;
      return true;
    }
    return false;
  }

  Functions functions_;
};

/// The limits, and that no variable goes astray; each less `slack`.
void add_limits(std::vector<Convex>& all, const GeometricProgram& program, const Vector& r) {
  for (const Posynomial& limit : program.limits) {
    all.push_back(log_of(limit, r));
    all.back().value -= kSlack;
  }
  for (Eigen::Index i = 0; i < r.size(); ++i)
    for (const double sign : {-1.0, 1.0})
      all.push_back({sign * r[i] - kFarthest, sign * Vector::Unit(r.size(), i), Matrix::Zero(r.size(), r.size())});
}

/// A point inside the limits:  min s  where log g_i <= s;  the nearest where there is none.
Vector inside(const GeometricProgram& program) {
  Vector z = Vector::Zero(static_cast<Eigen::Index>(program.variables) + 1);
  const Eigen::Index s = z.size() - 1;
  z[s] = std::max(-1.0, worst_limit(program, z.head(s))) + 1;
  const CentralPath path([&](const Vector& at) {
    std::vector<Convex> inner;
    add_limits(inner, program, at.head(s));
    std::vector<Convex> all{{at[s], Vector::Unit(s + 1, s), Matrix::Zero(s + 1, s + 1)}};
    for (const Convex& limit : inner) {
      Convex& c = all.emplace_back(Convex{limit.value - at[s], Vector(s + 1), Matrix::Zero(s + 1, s + 1)});
      c.gradient << limit.gradient, -1;
      c.hessian.topLeftCorner(s, s) = limit.hessian;
    }
    all.push_back({-2 - at[s], -Vector::Unit(s + 1, s), Matrix::Zero(s + 1, s + 1)});  // deep enough
    return all;
  });
  path.follow(z, [&](const Vector& at) { return at[s] < -0.01; });
  return z.head(s);
}

Vector near_optimum(const GeometricProgram& program, Vector r) {
  const CentralPath path([&](const Vector& at) {
    std::vector<Convex> all{log_of(program.objective, at)};
    add_limits(all, program, at);
    return all;
  });
  path.follow(r, [](const Vector&) { return false; });
  return r;
}

/// NLopt's view of a posynomial's logarithm.
double seen(const std::vector<double>& r, std::vector<double>& gradient, void* data) {
  const Convex f = log_of(*static_cast<const Posynomial*>(data),
                          Eigen::Map<const Vector>(r.data(), static_cast<Eigen::Index>(r.size())));
  if (!gradient.empty()) Vector::Map(gradient.data(), f.gradient.size()) = f.gradient;
  return f.value;
}

/// Sequential quadratic programs from near the optimum: they end in a corner of the limits exactly, or get stuck.
Vector polished(GeometricProgram program, const Vector& near) {
  std::vector<double> r(near.data(), near.data() + near.size());
  nlopt::opt opt(nlopt::LD_SLSQP, static_cast<unsigned>(r.size()));
  opt.set_min_objective(seen, &program.objective);
  for (Posynomial& limit : program.limits) opt.add_inequality_constraint(seen, &limit, 0);
  opt.set_xtol_rel(1e-13);
  opt.set_maxeval(50);
  double value = 0;
  try {
    opt.optimize(r, value);
  } catch (const std::runtime_error&) {
    return near;
  }
  return Eigen::Map<Vector>(r.data(), near.size());
}

/// The least |g + A l| + slack l over l >= 0 that use at most as many of A's columns as there are variables.
double least_residual(const Vector& g, const Matrix& a, const Vector& slack) {
  double least = g.lpNorm<Eigen::Infinity>();
  const auto columns = static_cast<unsigned>(a.cols());
  for (unsigned chosen = 1; chosen < (1U << columns); ++chosen) {
    std::vector<Eigen::Index> some;
    for (unsigned c = 0; c < columns; ++c)
      if ((chosen >> c & 1U) != 0) some.push_back(static_cast<Eigen::Index>(c));
    if (some.size() > static_cast<std::size_t>(g.size())) continue;
    const Matrix part = a(Eigen::all, some);
    const Vector l = part.colPivHouseholderQr().solve(-g);
    if (l.minCoeff() < 0) continue;
    const Vector room = slack(some);
    least = std::min(least, (g + part * l).lpNorm<Eigen::Infinity>() + room.dot(l));
  }
  return least;
}

double kkt_residual(const GeometricProgram& program, const Vector& r) {
  std::vector<Convex> met;
  for (const Posynomial& limit : program.limits)
    if (const Convex g = log_of(limit, r); g.value >= -kNear) met.push_back(g);
  const auto count = static_cast<Eigen::Index>(met.size());
  Matrix near(r.size(), count);
  Vector slack(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    near.col(i) = met[static_cast<std::size_t>(i)].gradient;
    slack[i] = std::max(0.0, -met[static_cast<std::size_t>(i)].value);
  }
  return least_residual(log_of(program.objective, r).gradient, near, slack) + std::max(0.0, worst_limit(program, r));
}

}  // namespace

Posynomial operator+(Posynomial a, const Posynomial& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Posynomial operator*(const Posynomial& a, const Posynomial& b) {
  Posynomial product;
  for (const Monomial& left : a)
    for (const Monomial& right : b) {
      Monomial& term = product.emplace_back(left);
      term.coefficient *= right.coefficient;
      for (std::size_t i = 0; i < term.powers.size(); ++i) term.powers[i] += right.powers[i];
    }
  return product;
}

Posynomial operator*(double factor, Posynomial a) {
  for (Monomial& term : a) term.coefficient *= factor;
  return a;
}

double value_of(const Posynomial& sum, const std::vector<double>& x) {
  double total = 0;
  for (const Monomial& term : sum) {
    double product = term.coefficient;
    for (std::size_t i = 0; i < x.size(); ++i) product *= std::pow(x[i], term.powers[i]);
    total += product;
  }
  return total;
}

Optimum solve(const GeometricProgram& program) {
  Optimum best;
  const Vector start = inside(program);
  if (!program.limits.empty() && worst_limit(program, start) >= kSlack) return best;
  Vector r = near_optimum(program, start);
  best.kkt_residual = kkt_residual(program, r);
  const Vector corner = polished(program, r);
  const double residual = kkt_residual(program, corner);
  if (residual < best.kkt_residual && worst_limit(program, corner) < kSlack) {
    r = corner;
    best.kkt_residual = residual;
  }
  best.feasible = true;
  best.value = std::exp(log_of(program.objective, r).value);
  for (const double log_x : r) best.x.push_back(std::exp(log_x));
  return best;
}

}  // namespace mote::design
