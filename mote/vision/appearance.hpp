#pragma once
/// The online appearance model: how each pixel of the template looks, as a mixture of three Gaussians learnt by EM.

#include <array>
#include <span>
#include <vector>

#include "mote/vision/patch.hpp"

namespace mote::vision {

/// What may explain a pixel.
enum Cause : std::size_t {
  kStable,     ///< what has stood there for long: learnt mean and variance
  kWandering,  ///< what stood there in the last frame
  kLost,       ///< anything: occlusion, noise
  kCauses
};

struct AppearanceOptions {
  double half_life = 30;        ///< frames after which an observation counts half
  double first_sd = 0.35;       ///< standard deviation of stable and wandering pixels at the start, in patch contrasts
  double least_sd = 0.20;       ///< the stable component never gets sharper: registration is never perfect
  double lost_sd = 1.6;         ///< of the lost component, whose mean is 0
  double outlier_share = 0.35;  ///< a patch with more lost pixels than this teaches nothing
};

/// The mixture of every pixel and its update.
///
///   p(z_j) = sum_i m_ij N(z_j; mu_ij, s_ij^2)
///   o_ij = m_ij N(z_j; mu_ij, s_ij^2) / p(z_j)                     responsibility of cause i
///   m_ij <- a o_ij + (1 - a) m_ij,  M_pj <- a z_j^p o_Sj + (1 - a) M_pj,   a = 1 - exp(-log 2 / half life)
///   mu_Sj = M_1j / m_Sj,  s_Sj^2 = M_2j / m_Sj - mu_Sj^2;   mu_Wj = z_j of the last patch;   mu_Lj = 0
///
/// A pixel whose cause is most likely lost stays as it is, and a patch with too many of them teaches nothing: what
/// hides the target is not learnt. No mixing weight falls below 0.02, so that no cause is ever ruled out.
///
/// shape   patches: (kPixels,), normalised
/// source  Zhou, Chellappa & Moghaddam 2004, sec. III-A; Jepson, Fleet & El-Maraghi 2003
class Appearance {
 public:
  /// What a pixel knows; the wandering variance is first_sd^2.
  struct Pixel {
    std::array<double, kCauses> mixing;
    double moment1, moment2;  ///< M_1, M_2 of the stable component
    double wandering_mean;
  };

  Appearance(std::span<const float> first, const AppearanceOptions& options);

  /// Learns from the patch at the estimate, unless too much of it is lost; `rate` scales the forgetting a, in [0, 1].
  /// Returns the share of lost pixels.
  double learn(std::span<const float> patch, double rate = 1);
  /// The share of pixels whose likeliest cause is lost.
  double lost_share(std::span<const float> patch) const;
  /// Mean over the pixels of log p(z_j), by the table: what weighs a particle.
  ///
  /// unit    nat a pixel
  /// error   that of rounding z to 1/8 of a contrast: about -0.02 nat for a sharp pixel, whatever the pose
  /// cost    O(kPixels): about 0.6 us
  double mean_log_density(std::span<const float> patch) const;
  /// The same by the equation, in double: the referee of the table.
  double exact_mean_log_density(std::span<const float> patch) const;
  /// Sum of squared distances to the stable means over pixels, a mean per pixel: PPF's distance.
  double mean_squared_distance(std::span<const float> patch) const;

  const Pixel& pixel(std::size_t j) const { return pixels_[j]; }
  double stable_mean(std::size_t j) const { return pixels_[j].moment1 / pixels_[j].mixing[kStable]; }
  double stable_variance(std::size_t j) const;

 private:
  static constexpr std::size_t kLevels = 64;  // of a normalised pixel, from -4 to 4

  std::array<double, kCauses> joint(std::size_t j, double z) const;
  void tabulate();

  AppearanceOptions options_;
  std::vector<Pixel> pixels_;
  std::vector<float> table_;  // (kPixels, kLevels) log densities
  std::vector<float> means_;  // (kPixels,) stable means
};

}  // namespace mote::vision
