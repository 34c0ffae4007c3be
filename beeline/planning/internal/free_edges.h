#pragma once

#include <beeline/certificate/clearance.h>
#include <beeline/collision/collision_model.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Proofs of straight joint motions in the scene of a model, which outlives the object, at most
/// `most` of them.
class FreeEdges {
 public:
  FreeEdges(const CollisionModel& model, int most, BudgetMeter& budget);

  /// Whether no more motions are examined: so many were, or the budget has ended.
  bool ended() { return count_ >= most_ || budget_.ended(0); }

  /// Returns the fraction of the straight motion from a to b, from 0 to 1, up to which it is proved
  /// to keep the clearance: 1 for all of it, 0 if it was not examined.
  double free_fraction(const Configuration& a, const Configuration& b);
  bool is_free(const Configuration& a, const Configuration& b) { return free_fraction(a, b) == 1; }

  /// Whether a motion of two samples or more, from time 0 and in the order of the arm's joints, is
  /// proved.
  bool is_free(const Trajectory& motion) { return free_time(motion) == motion.times.back(); }

  std::size_t count() const { return count_; }  ///< of the motions that were examined

 private:
  /// Returns the time up to which a motion that begins at time 0 is proved: 0 if it was not
  /// examined.
  double free_time(const Trajectory& motion);

  const CollisionModel& model_;
  const std::size_t most_;
  BudgetMeter& budget_;
  Trajectory edge_;
  std::size_t count_ = 0;
};

}  // namespace beeline::internal
