#pragma once

#include <beeline/certificate/clearance.h>
#include <beeline/collision/collision_model.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Proofs of straight joint motions in the scene of a model, which outlives the object.
class FreeEdges {
 public:
  FreeEdges(const CollisionModel& model, BudgetMeter& budget);

  /// Returns the fraction of the straight motion from a to b, from 0 to 1, up to which it is proved
  /// to keep the clearance: 1 for all of it, 0 also if the budget has ended.
  double free_fraction(const Configuration& a, const Configuration& b);
  bool is_free(const Configuration& a, const Configuration& b) { return free_fraction(a, b) == 1; }

  /// Whether a motion of two samples or more, in the order of the arm's joints, is proved.
  bool is_free(const Trajectory& motion);

  std::size_t count() const { return count_; }  ///< of the motions that were examined

 private:
  const CollisionModel& model_;
  BudgetMeter& budget_;
  Trajectory edge_;
  std::size_t count_ = 0;
};

}  // namespace beeline::internal
