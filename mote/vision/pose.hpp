#pragma once
/// Where the target is: the state of the visual model, boxes, and the affine map from the template to the frame.

#include <array>
#include <cmath>
#include <cstddef>

namespace mote::vision {

/// An axis-aligned box in pixels: it covers [x, x + w) x [y, y + h), pixel i covers [i, i + 1).
struct Box {
  double x = 0, y = 0, w = 0, h = 0;

  double centre_x() const { return x + w / 2; }
  double centre_y() const { return y + h / 2; }
  double area() const { return w * h; }
};

/// Share of their union that two boxes have in common, in [0, 1]; 0 when a number is missing.
///
/// source  Everingham et al. 2010, sec. 4.2
double overlap(const Box& a, const Box& b);

/// Distance of the centres, px.
double centre_distance(const Box& a, const Box& b);

/// Components of the state, in order: centre and its velocity, logarithms of the sides relative to the first box,
/// rotation and skew.
enum Component : std::size_t { kX, kY, kVx, kVy, kLogW, kLogH, kAngle, kSkew, kComponents };

template <class S>
using PoseOf = std::array<S, kComponents>;
using Pose = PoseOf<double>;

/// Sides of the first box, px: what a pose's log sides refer to.
struct Size {
  double w = 1, h = 1;
};

/// The affine map of the template square [-1/2, 1/2]^2 into the frame.
///
///   (X, Y) = (x, y) + R(angle) [1 skew; 0 1] diag(w e^log_w, h e^log_h) (u, v)
///
/// unit    px; X to the right, Y down, so a positive angle turns clockwise on the screen
struct Affine {
  double x, y;    ///< image of the template's centre
  double xu, yu;  ///< image of a step of 1 along u
  double xv, yv;  ///< image of a step of 1 along v
};

template <class S>
Affine affine_of(const PoseOf<S>& pose, const Size& first) {
  const double w = first.w * std::exp(static_cast<double>(pose[kLogW]));
  const double h = first.h * std::exp(static_cast<double>(pose[kLogH]));
  const double c = std::cos(static_cast<double>(pose[kAngle]));
  const double s = std::sin(static_cast<double>(pose[kAngle]));
  const auto k = static_cast<double>(pose[kSkew]);
  return {static_cast<double>(pose[kX]), static_cast<double>(pose[kY]), w * c, w * s, h * (k * c - s), h * (k * s + c)};
}

/// The pose of an upright box.
Pose pose_of(const Box& box, const Size& first);

/// The box of a pose: its centre and its two sides, upright whatever its rotation and skew.
Box box_of(const Pose& pose, const Size& first);

/// Whether every component is a finite number and the sides are within a factor 1000 of the first.
bool is_sane(const Pose& pose);

}  // namespace mote::vision
