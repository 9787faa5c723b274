#pragma once
/// Patches: the template square as a particle sees it, sampled from a window and normalised.

#include <cstddef>
#include <span>
#include <vector>

#include "mote/vision/window.hpp"

namespace mote::vision {

/// A side of the template; patches have kSide x kSide pixels, row by row.
inline constexpr std::size_t kSide = 32;
inline constexpr std::size_t kPixels = kSide * kSide;

/// Samples the pixels of the template under an affine map, bilinearly.
///
///   z_j = window(A (u_j, v_j)),   u_j, v_j = (column + 1/2)/kSide - 1/2, (row + 1/2)/kSide - 1/2
///
/// shape   window: grey, CV_32F, at least 2 x 2; z: (kPixels,)
/// error   none; outside the window its border goes on
/// cost    O(kPixels), vectorised: about 1 us
void sample_patch(const Window& window, const Affine& map, std::span<float> z);

/// Takes mean and contrast out of a patch, so that a change of brightness or gain leaves no trace.
///
///   z_j <- (z_j - mean z) / max(sd z, kLeastContrast)
void normalise_patch(std::span<float> z);

/// The contrast below which a patch is flat, in grey levels of 255.
inline constexpr float kLeastContrast = 2;

}  // namespace mote::vision
