#pragma once

#include <Eigen/Core>

namespace beeline::internal {

/// A set of configurations about a straight joint motion: middle + s half_motion + r for s from -1
/// to 1 and |r_k| <= slack_k.
struct JointTube {
  Eigen::Ref<const Eigen::VectorXd> middle;
  Eigen::Ref<const Eigen::VectorXd> half_motion;  ///< joint motion from the middle to the end
  Eigen::Ref<const Eigen::VectorXd> slack;        ///< 0 or more
};

}  // namespace beeline::internal
