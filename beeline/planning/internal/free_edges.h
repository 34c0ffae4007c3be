#pragma once

#include <beeline/certificate/clearance.h>
#include <beeline/collision/collision_model.h>
#include <beeline/collision/internal/sampled_collisions.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Examines straight joint motions in the scene of a model, which outlives the object: at most
/// `most` by samples, which a search of a path asks, and some of these by proofs.
class FreeEdges {
 public:
  FreeEdges(const CollisionModel& model, int most, BudgetMeter& budget);

  /// Whether no more motions are examined: so many were, or the budget has ended.
  bool ended() { return count_ >= most_ || budget_.ended(0); }

  /// Returns the fraction of the straight motion from a to b, from 0 to 1, up to which no sample is
  /// blocked: 1 for all of it, 0 if it was not examined. a is taken as free.
  double sampled_fraction(const Configuration& a, const Configuration& b);
  /// Whether no sample of the straight motion from a to b is blocked. It is not if it was not
  /// examined. a and b are taken as free.
  bool seems_free(const Configuration& a, const Configuration& b);

  /// Halves the distance of the samples: for a motion without a blocked one that is not proved.
  void sample_more_densely();

  /// Whether a motion is proved to keep the clearance; not if the budget ends the proof. The motion
  /// is straight, or of two samples or more in the order of the arm's joints.
  bool is_free(const Configuration& a, const Configuration& b);
  bool is_free(const Trajectory& motion) { return is_free(motion, budget_); }

  /// Like is_free(), within `max_work` units, to twice the default resolution of prove_clearance():
  /// its timed motion, which differs a little from the straight one, can then be proved, too.
  bool is_free_closely(const Configuration& a, const Configuration& b, std::int64_t max_work);

  /// Whether the straight motions from each waypoint to the next are proved. Where the budget has
  /// ended, a bounded amount of work is added: a path that was found before is kept.
  bool are_free(const std::vector<Configuration>& waypoints);

  /// Number of the motions that were sampled.
  std::size_t count() const { return count_; }

 private:
  using Fractions = Eigen::Array<double, SampledCollisions::at_once, 1>;

  int sample_count(double length) const;

  /// Tests eight samples of the motion from a by `change`, at these fractions of it. Returns the
  /// index of the first that is blocked; eight if none is, 0 if the budget has ended.
  int first_blocked(const Configuration& a, const Configuration& change,
                    const Fractions& fractions);

  bool is_free(const Trajectory& motion, BudgetMeter& budget) const;

  const CollisionModel& model_;
  const std::size_t most_;
  BudgetMeter& budget_;
  SampledCollisions samples_;
  std::vector<double> lanes_;  ///< eight configurations
  Trajectory edge_;
  double spacing_ = 0.05;  ///< of samples along a motion, as the norm of the difference
  std::size_t count_ = 0;
};

}  // namespace beeline::internal
