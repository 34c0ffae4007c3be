#pragma once

#include <beeline/certificate/internal/clearance_search.h>

namespace beeline::testing {

/// The proof that the pairs of a model keep their clearance raised by `beyond`, m. The motion has
/// two samples or more.
inline ClearanceProof proof_beyond(const CollisionModel& model, const Trajectory& motion,
                                   double beyond) {
  const ClearanceOptions options;
  const internal::MotionTubes tubes(motion);
  internal::BudgetMeter budget{Budget()};
  return internal::ClearanceSearch(model.bodies(), tubes, options, budget, beyond).run();
}

}  // namespace beeline::testing
