#pragma once

#include <beeline/inverse/inverse_kinematics.h>

#include "cases.h"

namespace beeline::bench {

/// Calls Beeline's inverse kinematics for a case; the only caller in the benchmark.
class BeelineCase {
 public:
  BeelineCase(const BenchArm& arm, CaseKind kind);

  /// Returns the number of solutions.
  int solve(const Pose& world_T_tool, const Configuration& seed);

  /// Returns solution i of the last call.
  Configuration solution(int i) const { return solutions_.col(i); }

 private:
  Arm arm_;
  InverseOptions options_;
  std::optional<double> last_;
  Configuration seed_;
  Eigen::MatrixXd solutions_;
};

}  // namespace beeline::bench
