#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <beeline/inverse/analytic/pieper_branches.h>
#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Analytic inverse kinematics of an arm and a task by a PieperLoop, which has six joints:
/// - an arm of seven joints has its last or its first joint locked at a given value, one that moves
///   in self-motions;
/// - an arm of four or five joints gets virtual revolute joints at the tool. A spatial task needs
///   them at zero; a task that leaves one rotation of five joints undetermined, about an axis of
///   the tool or of the world (`direction`, `approach:xy`), leaves it free;
/// - an arm of five joints whose last one only rotates the tool about the axis that the task leaves
///   free has this joint as an input, and a virtual joint that must be zero;
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

  /// Returns the coordinate that is an input: the first or the last of seven joints, or the last of
  /// five joints if it spins().
  std::optional<int> locked() const { return locked_; }

  /// Whether every value of the locked coordinate solves: it rotates the tool about the axis that
  /// the task leaves free.
  bool spins() const { return locked_ == 4; }

  /// Returns the solver of one goal, or null if it has no loop. `chain` is the arm's. The loop
  /// depends on the goal, and its solver is written to `own`, if the task leaves free a rotation
  /// about an axis of the world, which the tool sees as the goal turns it.
  const PieperSolver* for_goal(const Chain& chain, const Pose& world_T_tool,
                               std::unique_ptr<PieperSolver>& own) const;

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

  /// Writes lane `lane` of the branches to q, a configuration of the arm.
  void configuration(const PieperBranches& found, int lane, double locked_value, double* q) const;

 private:
  static constexpr int virtual_joint = -1;

  bool lock_last(const Chain& chain);
  bool lock_first(const Chain& chain);
  bool add_virtual(const Chain& chain, const std::vector<Vector3>& axes, bool free);
  bool leave_free(const Chain& chain, int axis, Frame frame);

  PieperLoop loop_;
  /// For each joint of the loop, its coordinate in the arm, or virtual_joint.
  std::array<int, 6> coordinates_{};
  std::array<bool, 6> free_{};  ///< for each joint of the loop, whether it is virtual and free
  int dof_ = 6;
  std::optional<int> locked_;
  std::optional<int> world_axis_;  ///< axis of the world about which the virtual joint rotates
  Chain::Link locked_link_;
  Pose before_locked_ = Pose::Identity();  ///< constant transforms before and after the motion of
  Pose after_locked_ = Pose::Identity();   ///< the locked joint, outside the loop of the other six
};

}  // namespace beeline::internal
