#pragma once
/// The visual model: a target's pose moves at random and a frame says how well a pose fits. A host model: double and
/// float only, because a frame's likelihood is no arithmetic on the state.

#include <memory>
#include <string>
#include <vector>

#include "mote/filter/particles.hpp"
#include "mote/filter/propose.hpp"
#include "mote/filter/weigh.hpp"
#include "mote/software/threads.hpp"
#include "mote/vision/appearance.hpp"
#include "mote/vision/extent.hpp"
#include "mote/vision/place.hpp"
#include "mote/vision/stages.hpp"

namespace mote::vision {

/// Standard deviations of a step of the motion.
struct Motion {
  double place = 0.05;    ///< of the centre, in geometric means of the sides
  double speed = 0.02;    ///< of the velocity, likewise, per frame; above 0: second order
  double damping = 0.8;   ///< velocity kept from frame to frame
  double size = 0.010;    ///< of the logarithm of both sides together
  double aspect = 0.003;  ///< of the logarithm of one side against the other
  double angle = 0.01;    ///< rad
  double skew = 0.005;
};

/// How the parts of the likelihood add up, in nat.
struct Likelihood {
  bool by_distance = false;  ///< PPF: a Gaussian of the distance to the stable template instead of the mixture
  double appearance = 10;    ///< weight of the mean log density of a pixel: tempers 1024 correlated pixels
  double place = 40;         ///< weight of the place filter's response
  double extent = 80;        ///< weight of the extent filter's response
  double aspect_sd = 0.02;   ///< of the shape around the first box's
  double angle_sd = 0.3;     ///< rad, around upright; of the skew, too
};

/// Which witnesses weigh a pose.
enum class Fit {
  kFused,     ///< appearance, place and extent
  kMixture,   ///< the appearance alone: Zhou et al.
  kDistance,  ///< a Gaussian of the distance to the stable template: PPF
};
Likelihood likelihood_of(Fit fit);

/// What a frame says of every pose, and how poses move: filled by the tracker before each step, read by the model.
struct Sight {
  Size first;  ///< sides of the first box
  Motion motion;
  Likelihood likelihood;
  Window window;  ///< grey, around the target, about one pixel a pixel of the template
  const Appearance* appearance = nullptr;
  ResponseMap place;
  ExtentResponse extent;
  double log_size = 0;              ///< of the box that `extent` refers to: mean of its log sides
  double drift_x = 0, drift_y = 0;  ///< px: where the target went since the last frame, as far as is known
  double width = 0, height = 0;     ///< of the frame, px
  std::vector<Pose> start;          ///< poses that a filter starts from
};

/// The fit of a pose: its log likelihood up to a constant, nat.
///
///   appearance mean_j log p(z_j) + place R(x, y) + extent E(log size) - (log w/h)^2/(2 sd^2) - (angle^2 + skew^2)/(2
///   sd^2)
///
/// error   none; a pose that is no pose, or whose centre left the frame, gives -infinity
double log_fit(const Sight& sight, const Pose& pose);

/// A pose one frame later, from its noise: eight standard normal numbers.
Pose moved(const Sight& sight, const Pose& before, const std::array<double, kComponents>& noise);

/// The model that filters see.
///
///   centre' = centre + velocity + N(0, place^2);  velocity' = damping velocity + N(0, speed^2);
///   log sides, angle and skew walk at random;  p(y | x) = exp(log_fit)
///
/// source  IMH-OPT VI-A; Zhou, Chellappa & Moghaddam 2004, sec. II
struct VisualModel {
  template <class S>
  using State = PoseOf<S>;

  std::shared_ptr<const Sight> sight;
  std::shared_ptr<Crew> crew;
  std::shared_ptr<StageTimes> times;

  std::vector<Quantity> states() const;
  std::vector<Column> columns() const;

  template <class S, class D>
  State<S> initial(D& draw) const {
    const double place = static_cast<double>(draw.uniform()) * static_cast<double>(sight->start.size());
    return as<S>(sight->start[std::min(static_cast<std::size_t>(place), sight->start.size() - 1)]);
  }
  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    std::array<double, kComponents> noise{};
    for (double& n : noise) n = static_cast<double>(draw.normal());
    return as<S>(moved(*sight, as<double>(before), noise));
  }
  template <class S>
  S log_likelihood(Step, const State<S>& x, const Row<S>&) const {
    return static_cast<S>(log_fit(*sight, as<double>(x)));
  }
  /// Adds the log likelihoods of particles from `first` on, by all threads; the sums do not depend on them. A particle
  /// takes some microseconds, as long as a block of numbers, which a crew reckons with.
  template <class R>
  void weigh_all(Step t, Rows<R> rows, const Particles<R>& x, std::size_t first, std::span<double> log_weights) const {
    const Stopwatch watch(times->weigh);
    times->particles += x.size() - first;
    crew->run(x.size() - first, [&](std::size_t, std::size_t from, std::size_t to) {
      State<R> pose{};
      for (std::size_t i = first + from; i < first + to; ++i) {
        x.read(i, pose);
        log_weights[i] += mote::log_likelihood<R>(*this, t, pose, rows);
      }
    });
  }

 private:
  template <class S, class T>
  static State<S> as(const std::array<T, kComponents>& pose) {
    State<S> out{};
    for (std::size_t d = 0; d < kComponents; ++d) out[d] = static_cast<S>(pose[d]);
    return out;
  }
};

}  // namespace mote::vision
