#pragma once
/// Confidence: how sure the tracker is of the target, and what follows from it.

namespace mote::vision {

struct ConfidenceOptions {
  double learn = 0.55;   ///< score from which a frame is learnt
  double full = 0.8;     ///< score from which a frame is learnt at the full rate
  double hidden = 0.45;  ///< score below which the target is taken to be hidden
  int patience = 4;      ///< hidden frames after which the target is lost
  double near = 0.5;     ///< response that shows it again where it may have got to, in usual responses
  double far = 0.65;     ///< and elsewhere, where its score must be `far_score`, too
  double far_score = 0.6;
  int doubt = 25;            ///< frames without a sure one after which it is lost
  double usual_rate = 0.05;  ///< with which the usual response follows
};

/// What a frame shows of the target.
enum class Sighting { kSure, kUnsure, kHidden };

/// Scores a place by two witnesses that err apart: the place filter, which knows the surroundings, and the appearance
/// model, which knows the pixels of the target.
///
///   score = 1/2 min(1, response / usual response) + 1/2 min(1, exp(log density + 1/2))
///
/// The log density is the appearance's, a mean over the pixels, nat: about -1/2 where the target is seen, and below
/// -1.6 (what the lost component gives any normalised patch) where it is not.
///
/// The target is lost after `patience` hidden frames on end, or `doubt` frames of which none was sure.
class Confidence {
 public:
  /// response: of the place filter to the frame that it has just learnt, which flatters it.
  Confidence(const ConfidenceOptions& options, double response) : options_(options), usual_(kFlattery * response) {}

  double score(double response, double log_density) const;
  /// How much a frame teaches, in [0, 1]: what is half hidden is learnt slowly.
  ///
  ///   weight = ((score - hidden) / (full - hidden))^2, cut at 0 and 1
  double weight(double score) const;
  /// Notes a frame's sighting; a sure one moves the usual response.
  Sighting note(double response, double log_density);
  /// Notes that the target was found again, or one more frame without it.
  void note_search(bool found);
  bool lost() const { return hidden_ >= options_.patience || since_sure_ >= options_.doubt; }
  /// Frames since the target was lost.
  int gone() const { return gone_; }
  /// Whether the target may have got as far as `distance` from where it was lost, in geometric means of its sides.
  bool is_near(double distance) const;
  /// The response that shows it again at that distance: infinity where it cannot be yet. What is asked elsewhere falls
  /// a little with time, so that a target that has changed is not lost for good.
  double needed(double distance) const;
  /// Whether a place at that distance shows the target again. After a long doubt only a sure one does.
  bool is_found(double response, double log_density, double distance) const;

 private:
  static constexpr double kFlattery = 0.5;

  ConfidenceOptions options_;
  double usual_;
  int sure_ = 0, hidden_ = 0, since_sure_ = 0, gone_ = 0;
};

}  // namespace mote::vision
