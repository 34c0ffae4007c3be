#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <beeline/inverse/analytic/pieper_branches.h>
#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Analytic inverse kinematics of an arm and a task by a PieperLoop, which has six joints:
/// - an arm of seven joints has its first or its last joint locked at a given value;
/// - an arm of four or five joints gets virtual revolute joints at the tool. A spatial task needs
///   them at zero; a task that ignores the roll of the tool (111110 in the tool frame) leaves them
///   free;
/// - an arm of three joints with a position task gets a virtual wrist of three free joints.
class PieperSolver {
 public:
  /// Returns nothing if no loop is found, or if the arm has mimic or helical joints.
  static std::optional<PieperSolver> make(const Arm& arm, const Task& task);

  /// Returns a description such as `three axes meet (joints 4, 5, 6)`, see description(). If the
  /// arm is a longer arm with coordinate `removed` locked, joints are numbered as in the longer
  /// arm.
  std::string family(std::optional<int> removed = std::nullopt) const {
    return description(loop_, dof_, locked_ == 0 ? locked_ : removed);
  }

  /// Returns the coordinate of an arm of seven joints that is an input: the first or the last.
  std::optional<int> locked() const { return locked_; }

  /// Whether there are virtual joints. If so, a continuum of solutions may concern only these.
  bool has_virtual_joints() const { return dof_ < 6; }

  /// Whether some virtual joints are free. Branches that differ only in these are one solution.
  bool has_free_joints() const {
    return std::find(free_.begin(), free_.end(), true) != free_.end();
  }

  /// Returns the joints d, e, f or a that are free in one of the lanes, as indices of
  /// PieperRequest::seed. They have taken the values of the seed.
  std::vector<int> free_joints(const PieperBranches& found) const;

  /// Returns the extent of the loop, metres: lengths are rounded relative to it.
  double size() const { return loop_.size; }

  /// Returns a request with everything except the goal. Seed, weights and limits belong to the
  /// arm's coordinates. max_residual is the rounding of the solver or `tolerance` if that is less.
  PieperRequest request(const ConfigurationRef& seed, const Configuration& weights,
                        const Configuration& lower, const Configuration& upper,
                        double tolerance = 1e-10) const;

  /// Computes the branches at a goal, a rigid motion, with the locked coordinate at `locked_value`.
  void branches(const Pose& world_T_tool, double locked_value, PieperRequest& request,
                PieperBranches& found) const;

  /// Writes lane `lane` of the branches as a configuration of the arm.
  void configuration(const PieperBranches& found, int lane, double locked_value,
                     Eigen::Ref<Configuration> q) const;

 private:
  static constexpr int virtual_joint = -1;

  bool lock_last(const Chain& chain);
  bool lock_first(const Chain& chain);

  PieperLoop loop_;
  /// For each joint of the loop, its coordinate in the arm, or virtual_joint.
  std::array<int, 6> coordinates_{};
  std::array<bool, 6> free_{};  ///< for each joint of the loop, whether it is virtual and free
  int dof_ = 6;
  std::optional<int> locked_;
  Chain::Link locked_link_;
  Pose before_locked_ = Pose::Identity();  ///< constant transforms before and after the motion of
  Pose after_locked_ = Pose::Identity();   ///< the locked joint, outside the loop of the other six
};

}  // namespace beeline::internal
