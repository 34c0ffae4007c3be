#pragma once

#include <vector>

#include <beeline/inverse/analytic/general_elimination.h>

namespace beeline {

/// All solutions of an arm with six revolute joints, whatever its geometry: up to 16 (Raghavan &
/// Roth 1993), limits ignored. How the loop is best cut is found out at construction, by trial on
/// random configurations of the arm. Arms with three axes that meet in one point or are parallel
/// have solutions in pairs that no cut tells apart: these are better solved by other means.
class GeneralSix {
 public:
  static constexpr int max_solutions = 16;

  /// Throws Error unless the chain has six links that turn, each by a coordinate of its own, q_i.
  explicit GeneralSix(const Chain& chain);

  /// Whether all trials but one in a hundred, which may be singular, were found again.
  bool reliable() const { return reliable_; }

  struct Found {
    int count = 0;          ///< solutions
    bool complete = false;  ///< every zero of the determinant led to one: there are no others
  };

  /// The solutions, one column each, in [-pi, pi]. Each has gone through forward kinematics, with
  /// an error below 1e-12 (of the arm's size, and radians). Solutions closer to each other than
  /// 1e-6 count as one. Does not allocate.
  /// Throws Error when q has fewer than 16 columns or the pose is not finite.
  Found solve(const Pose& world_T_tool,
              Eigen::Ref<Eigen::Matrix<double, 6, Eigen::Dynamic>> q) const;

 private:
  Pose base_inverse_, tool_inverse_;
  Pose rest_inverse_;  ///< of the last frame in the first at q = 0
  SixLinks six_;
  std::vector<GeneralElimination>
      eliminations_;  ///< best first; the others are for second opinions
  bool reliable_ = false;
};

}  // namespace beeline
