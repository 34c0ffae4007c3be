#pragma once

#include <vector>

#include <beeline/doctor/internal/reconciliation.h>

namespace beeline::internal {

/// A mistake in many numbers of one of two arms. With the mistake undone, the two may be equal up
/// to the differences that the explanations find.
struct Hypothesis {
  Arm a, b;                    ///< the arms, one of them changed
  ModelDifference difference;  ///< difference to report
  double scale = 1;            ///< lengths of a / lengths of A
};

/// Tables of the other convention, columns that are shifted or exchanged, angles in degrees.
std::vector<Hypothesis> table_hypotheses(const Arm& a, const Arm& b);

/// All lengths of one arm in another unit, or the arm in another size.
std::vector<Hypothesis> scale_hypotheses(const Arm& a, const Arm& b);

/// The numbers of all orientations read in another way.
std::vector<Hypothesis> rotation_hypotheses(const Arm& a, const Arm& b);

/// Two joints exchanged, or all in reverse order.
std::vector<Hypothesis> order_hypotheses(const Arm& a, const Arm& b);

/// Joints of the longer arm that the other one does not have: fixed, or left out with their frames.
struct MissingJoints {
  Hypothesis hypothesis;
  std::vector<std::size_t> kept;  ///< the longer arm's joints that remain
};
std::vector<MissingJoints> missing_joint_hypotheses(const Arm& a, const Arm& b);

}  // namespace beeline::internal
