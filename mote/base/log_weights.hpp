#pragma once
/// Weights in the log domain: a weight of zero is -infinity, nothing here underflows.

#include <cstddef>
#include <span>

namespace mote {

/// The logarithm of a sum of exponentials, and what is needed to use the weights.
struct LogSum {
  double largest;  ///< max_i log_weights[i]; -infinity when all weights are zero
  double log_sum;  ///< log sum_i exp(log_weights[i])
};

/// log sum_i exp(log_weights[i]), summed by blocks in a fixed order.
///
/// shape   log_weights: (N,); entries finite or -infinity
/// unit    nat
/// error   none; all -infinity gives {-infinity, -infinity}
/// cost    O(N), two passes, no allocation
LogSum log_sum_exp(std::span<const double> log_weights);

/// weights[i] = exp(log_weights[i] - largest): linear weights with maximum 1.
///
/// returns sum_i weights[i]
double exponentiate(std::span<const double> log_weights, double largest, std::span<double> weights);

/// Effective sample size: how many equally weighted particles would be as good as these.
///
///   ESS(w) = (sum_i w_i)^2 / sum_i w_i^2
///
/// shape   weights: (N,), linear, unnormalised
/// unit    particles, in [1, N] (never above N, so that "ESS <= N" always holds)
/// error   none; all zero gives 0
/// cost    O(N), one pass
/// source  Kong, Liu & Wong 1994, sec. 4.1
double effective_sample_size(std::span<const double> weights);

/// sum_i term(i) for i in [0, n), by blocks of 1024 in a fixed order: the same bits however the blocks are shared out.
template <class Term>
double ordered_sum(std::size_t n, Term&& term) {
  constexpr std::size_t kRun = 1024;
  double total = 0;
  double carry = 0;
  for (std::size_t start = 0; start < n; start += kRun) {
    const std::size_t stop = start + kRun < n ? start + kRun : n;
    double run = 0;
    for (std::size_t i = start; i < stop; ++i) run += term(i);
    const double step = run - carry;  // Kahan's compensation between blocks
    const double next = total + step;
    carry = (next - total) - step;
    total = next;
  }
  return total;
}

}  // namespace mote
