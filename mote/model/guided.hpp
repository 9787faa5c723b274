#pragma once
/// A proposal for models with Gaussian noise, guided by the observations through the model itself.

#include <array>

#include "mote/model/densities.hpp"
#include "mote/model/model.hpp"

namespace mote {

/// A model that `Guided` can propose for. Its next() is x = F(before, u) with kNoise standard normal draws u and no
/// uniform ones.
///
///   noise(t, x, before)          the u that leads from before to x: F(before, noise(t, x, before)) = x
///   innovations(t, x, row, add)  calls add(r, w) for each observation of the row that is seen: r, its residual in
///                                standard deviations, and w, the curvature of -log p along r (1 for a normal error)
template <class M>
concept HasNoise = HasTransition<M> && requires(const M& m, Step t, const typename M::template State<double>& x,
                                                const Row<double>& y, void (*add)(const double&, const double&)) {
  { m.template noise<double>(t, x, x) } -> std::same_as<std::array<double, M::kNoise>>;
  m.template innovations<double>(t, x, y, add);
};

/// Draws that were chosen: what next() is handed to move under a given noise.
template <class S, std::size_t D>
struct ChosenNoise {
  std::array<S, D> u;
  std::size_t taken = 0;
  S normal() { return u[taken++]; }
};

/// N(mean, precision^-1) in D dimensions, by the factor A of its precision A A'.
template <class S, std::size_t D>
struct NormalByPrecision {
  std::array<S, D> mean;
  std::array<std::array<S, D>, D> factor;  // lower triangle

  /// The normal with precision^-1 information as its mean. `precision` is symmetric and definite; its lower triangle is
  /// read.
  static NormalByPrecision of(const std::array<std::array<S, D>, D>& precision, const std::array<S, D>& information) {
    using namespace numbers;
    NormalByPrecision n{information, precision};
    auto& a = n.factor;
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        for (std::size_t k = 0; k < j; ++k) a[i][j] = a[i][j] - a[i][k] * a[j][k];
        a[i][j] = i == j ? sqrt(a[i][i]) : a[i][j] / a[j][j];
      }
    for (std::size_t i = 0; i < D; ++i) {
      for (std::size_t k = 0; k < i; ++k) n.mean[i] = n.mean[i] - a[i][k] * n.mean[k];
      n.mean[i] = n.mean[i] / a[i][i];
    }
    n.mean = n.solved(n.mean);
    return n;
  }

  /// A'^-1 v
  std::array<S, D> solved(std::array<S, D> v) const {
    for (std::size_t i = D; i-- > 0;) {
      for (std::size_t k = i + 1; k < D; ++k) v[i] = v[i] - factor[k][i] * v[k];
      v[i] = v[i] / factor[i][i];
    }
    return v;
  }

  /// The draw that the standard normal numbers z make.
  std::array<S, D> at(const std::array<S, D>& z) const {
    std::array<S, D> u = solved(z);
    for (std::size_t i = 0; i < D; ++i) u[i] = mean[i] + u[i];
    return u;
  }

  /// log density relative to N(0, I).
  S log_ratio_to_standard(const std::array<S, D>& u) const {
    using namespace numbers;
    S sum = S(0);
    for (std::size_t i = 0; i < D; ++i) {
      S z = S(0);
      for (std::size_t k = i; k < D; ++k) z = z + factor[k][i] * (u[k] - mean[k]);
      sum = sum + S(0.5) * (u[i] * u[i] - z * z) + log(factor[i][i]);
    }
    return sum;
  }
};

/// Noise chosen where the observations want it, and a defensive tenth of the model's own.
///
///   r_j(u) ~ a_j + b_j' (u - u0),   b_j by differences of half a standard deviation to both sides of u0
///   P = I + sum_j w_j b_j b_j',   m = P^-1 sum_j w_j b_j (b_j' u0 - a_j);   u0 = 0, then u0 = m   (Gauss-Newton)
///   u ~ g = 1/10 N(0, I) + 9/10 N(m, P^-1),   x = F(before, u),   p(x | before) / g(x | before, y) = N(u; 0, I) / g(u)
///
/// The tenth bounds the weights by ten times the likelihood, however wrong the lines are. Exact up to it where r is
/// linear.
///
/// shape   any model that HasNoise; all rows of the step count
/// error   none; without an observation g is the model's own transition
/// cost    2 (2 D + 1) moves and as many rows of innovations, for the draw and again for its density; D = kNoise
/// source  docs/filters.md (F33) to (F35); Doucet, Godsill & Andrieu 2000, section II-D (linearised optimal proposals)
struct Guided {
  static constexpr std::string_view kName = "guided";
  static constexpr std::string_view kMeaning =
      "noise drawn where the observations, linearised in it, want it, one tenth from the prior";
  static constexpr double kDefensive = 0.1;

  template <class S, HasNoise M, class D>
  StateOf<M, S> propose(const M& model, Step t, const StateOf<M, S>& before, Rows<S> y, D& draw) const {
    using namespace numbers;
    const S which = draw.uniform();
    std::array<S, M::kNoise> z;
    for (S& component : z) component = draw.normal();
    const auto guided = posterior(model, t, before, y).at(z);
    for (std::size_t i = 0; i < M::kNoise; ++i) z[i] = select(less(which, S(kDefensive)), z[i], guided[i]);
    return moved(model, t, before, z);
  }

  template <class S, HasNoise M>
  S log_density(const M& model, Step t, const StateOf<M, S>& x, const StateOf<M, S>& before, Rows<S> y) const {
    using namespace numbers;
    const S ratio = posterior(model, t, before, y).log_ratio_to_standard(model.template noise<S>(t, x, before));
    // log (eps + (1 - eps) exp(ratio)), by the larger of the two
    const S other = ratio + S(std::log((1 - kDefensive) / kDefensive));
    const S larger = S(0.5) * (other + abs(other));
    return model.template log_transition<S>(t, x, before) + S(std::log(kDefensive)) + larger +
           log(exp(-larger) + exp(other - larger));
  }

 private:
  static constexpr int kLinearisations = 2;
  static constexpr double kReach = 0.5;

  template <class S, class M>
  static StateOf<M, S> moved(const M& model, Step t, const StateOf<M, S>& before, const std::array<S, M::kNoise>& u) {
    ChosenNoise<S, M::kNoise> noise{u};
    return model.template next<S>(t, before, noise);
  }

  /// The posterior of the noise, its innovations linearised.
  template <class S, class M>
  static NormalByPrecision<S, M::kNoise> posterior(const M& model, Step t, const StateOf<M, S>& before, Rows<S> y) {
    std::array<S, M::kNoise> centre;
    centre.fill(S(0));
    NormalByPrecision<S, M::kNoise> normal{};
    for (int i = 0; i < kLinearisations; ++i) {
      normal = linearised(model, t, before, y, centre);
      centre = normal.mean;
    }
    return normal;
  }

  template <class S>
  struct Innovations {
    SmallVector<S> residuals, curvatures;
  };

  template <class S, class M>
  static Innovations<S> innovations(const M& model, Step t, const StateOf<M, S>& before, Rows<S> y,
                                    const std::array<S, M::kNoise>& u) {
    Innovations<S> all;
    const auto x = moved(model, t, before, u);
    for (const Row<S>& row : y)
      model.template innovations<S>(t, x, row, [&](const S& r, const S& w) {
        all.residuals.push_back(r);
        all.curvatures.push_back(w);
      });
    return all;
  }

  template <class S, class M>
  static NormalByPrecision<S, M::kNoise> linearised(const M& model, Step t, const StateOf<M, S>& before, Rows<S> y,
                                                    const std::array<S, M::kNoise>& centre) {
    constexpr std::size_t kD = M::kNoise;
    const Innovations<S> here = innovations(model, t, before, y, centre);
    std::array<SmallVector<S>, kD> slopes;  // of residual j along axis i at [i][j]
    for (std::size_t i = 0; i < kD; ++i) {
      std::array<S, kD> ahead = centre;
      std::array<S, kD> behind = centre;
      ahead[i] = centre[i] + S(kReach);
      behind[i] = centre[i] - S(kReach);
      slopes[i] = innovations(model, t, before, y, ahead).residuals;
      const SmallVector<S> back = innovations(model, t, before, y, behind).residuals;
      for (std::size_t j = 0; j < back.size(); ++j) slopes[i][j] = (slopes[i][j] - back[j]) * S(0.5 / kReach);
    }
    std::array<std::array<S, kD>, kD> precision;
    std::array<S, kD> information;
    information.fill(S(0));
    for (std::size_t i = 0; i < kD; ++i)
      for (std::size_t k = 0; k < kD; ++k) precision[i][k] = S(i == k ? 1 : 0);
    for (std::size_t j = 0; j < here.residuals.size(); ++j) {
      S wanted = -here.residuals[j];  // b' u where the line crosses zero
      for (std::size_t i = 0; i < kD; ++i) wanted = wanted + slopes[i][j] * centre[i];
      for (std::size_t i = 0; i < kD; ++i) {
        const S weighted = here.curvatures[j] * slopes[i][j];
        information[i] = information[i] + weighted * wanted;
        for (std::size_t k = 0; k < kD; ++k) precision[i][k] = precision[i][k] + weighted * slopes[k][j];
      }
    }
    return NormalByPrecision<S, kD>::of(precision, information);
  }
};

}  // namespace mote
