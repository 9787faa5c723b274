#pragma once
/// Where: a correlation filter on gradients, grey and colour around the target.

#include <optional>

#include "mote/vision/colour.hpp"
#include "mote/vision/correlation.hpp"
#include "mote/vision/window.hpp"

namespace mote::vision {

/// A frame in the forms that features are taken from.
struct View {
  Pyramid grey;    ///< CV_32F, 0..255
  Pyramid colour;  ///< CV_8UC3, BGR
  bool coloured;   ///< false when all three channels are the same
};

/// A View of an 8-bit frame with 1, 3 or 4 channels.
View view_of(const cv::Mat& frame);

/// A map of scores over the frame around a place.
struct ResponseMap {
  cv::Mat values;         ///< CV_32F
  double x0 = 0, y0 = 0;  ///< frame coordinates of point (0, 0)
  double sx = 1, sy = 1;  ///< points per frame pixel
  double outside = 0;     ///< value beyond the map

  /// Bilinear value at a place of the frame.
  double at(double x, double y) const;
};

/// The highest point of a map.
struct Peak {
  double x, y, value;
};
Peak peak_of(const ResponseMap& map);

struct PlaceOptions {
  double padding = 1.5;        ///< window beyond the target, in means of its sides, both ends together
  double window_area = 25600;  ///< of the window, in its own pixels
  double bump = 0.09;          ///< sd of the wanted response, in geometric means of the target's sides
  double regularisation = 1e-2;
  double colour_weight = 0.15;  ///< of the colour map in the response, where the frame has colours
};

/// Learns how the target differs from its surroundings and says where it is.
class PlaceFilter {
 public:
  PlaceFilter(const Box& first, const PlaceOptions& options);

  void learn(const View& view, const Box& box, double rate);
  /// Scores of all places in the window around the box; 1 is a perfect match. `reach` widens the window.
  ResponseMap respond(const View& view, const Box& box) const;

  /// How alike the colours in the box and the target's are, in [0, 1]; 1 in frames without colours.
  double likeness(const View& view, const Box& box) const;

  /// Sides of the window in sides of the target.
  double reach_x() const { return per_w_; }
  double reach_y() const { return per_h_; }

 private:
  Window window_around(const Pyramid& image, const Box& box) const;
  Planes features(const View& view, const Box& box) const;

  PlaceOptions options_;
  cv::Size size_;         // of the window, its own pixels
  double per_w_, per_h_;  // sides of the window in sides of the target
  cv::Mat hann_, wanted_;
  CorrelationFilter filter_;
  ColourModel colour_;
};

}  // namespace mote::vision
