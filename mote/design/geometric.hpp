#pragma once
/// Geometric programs: sums of monomials, which are convex in log coordinates, made least under limits.

#include <cstddef>
#include <vector>

namespace mote::design {

/// c x_1^a_1 x_2^a_2 ...,   c > 0.
struct Monomial {
  double coefficient;
  std::vector<double> powers;
};

/// A sum of monomials; none of them: 0.
using Posynomial = std::vector<Monomial>;

Posynomial operator+(Posynomial a, const Posynomial& b);
Posynomial operator*(const Posynomial& a, const Posynomial& b);
Posynomial operator*(double factor, Posynomial a);

double value_of(const Posynomial& sum, const std::vector<double>& x);

/// min objective(x)  where  limit(x) <= 1 for every limit, x > 0.
struct GeometricProgram {
  std::size_t variables = 0;
  Posynomial objective;
  std::vector<Posynomial> limits;
};

/// Its answer.
struct Optimum {
  bool feasible = false;
  double value = 0;  ///< of the objective
  std::vector<double> x = {};
  /// How far from optimal it may be, relative, 0 = exact: the least |grad log f + sum_i l_i grad log g_i| -
  /// sum_i l_i log g_i over l_i >= 0, in log coordinates, plus the largest log g_i > 0 (Karush, Kuhn & Tucker).
  double kkt_residual = 0;
};

/// Solves a program in log coordinates, where log of a posynomial is convex and every local optimum is the global one.
///
/// error   none; an infeasible program, one that needs log g_i > 1e-9 for some limit, says so
/// cost    about a millisecond for three variables
/// source  the central path (Boyd & Vandenberghe 2004, sec. 11.3) until near, NLopt's SLSQP (Kraft 1994) from there:
/// alone
///         it gets stuck in some of our programs; Boyd, Kim, Vandenberghe & Hassibi 2007 on geometric programs
Optimum solve(const GeometricProgram& program);

}  // namespace mote::design
