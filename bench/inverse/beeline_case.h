#pragma once

#include <beeline/inverse/inverse_kinematics.h>

#include "cases.h"

namespace beeline::bench {

/// Beeline asked the question of a case: the only place of the benchmark that calls it.
class BeelineCase {
 public:
  BeelineCase(const BenchArm& arm, CaseKind kind);

  /// Returns how many solutions there are.
  int solve(const Pose& world_T_tool, const Configuration& seed);

  /// Solution i of the last call.
  Configuration solution(int i) const { return solutions_.col(i); }

 private:
  InverseSolver solver_;
  std::optional<double> last_;
  Configuration seed_;
  Eigen::MatrixXd solutions_;
};

}  // namespace beeline::bench
