#pragma once

#include <vector>

#include <beeline/inverse/analytic/raghavan_roth_elimination.h>

namespace beeline::internal {

/// Computes all solutions of an arm with six revolute joints of general geometry, up to 16, joint
/// limits ignored (see Elimination). The constructor chooses among the eliminations by trial on
/// random configurations, in milliseconds. If three consecutive axes intersect or are parallel, the
/// zeros of every determinant are double: use PieperSolver.
class RaghavanRothSolver {
 public:
  static constexpr int max_solutions = 16;

  /// Throws Error unless the chain has six revolute links, link i with coordinate i.
  explicit RaghavanRothSolver(const Chain& chain);

  /// Uses the eliminations chosen for an arm of similar geometry, in a tenth of the time.
  RaghavanRothSolver(const Chain& chain, const RaghavanRothSolver& similar);

  /// Whether at least 99 % of the random configurations were found. Some of them may be singular.
  bool reliable() const { return reliable_; }

  struct Result {
    int count = 0;  ///< number of solutions
    bool complete =
        false;  ///< every zero of the determinant led to a solution: there are no others
  };

  /// Computes the solutions, one column each, in [-pi, pi]. Their errors by forward kinematics are
  /// below 1e-12 (of the arm's size, and radians). Solutions closer than 1e-6 rad count as one.
  /// Does not allocate. Throws Error when q has fewer than 16 columns or the pose is not finite.
  Result solve(const Pose& world_T_tool,
               Eigen::Ref<Eigen::Matrix<double, 6, Eigen::Dynamic>> q) const;

 private:
  void set_links(const Chain& chain);

  Pose base_inverse_, tool_inverse_;
  Pose last_T_first_at_zero_;  ///< the inverse of the product of all links at q = 0
  RevoluteLinks links_;
  /// Best first; the others confirm or complete the result of the first.
  std::vector<Elimination> eliminations_;
  bool reliable_ = false;
};

}  // namespace beeline::internal
