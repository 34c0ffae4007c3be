#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <beeline/inverse/analytic/six_lanes.h>
#include <beeline/kinematics/task.h>

namespace beeline {

/// The closed form of an arm and a task whose six joints make a SixLoop, found from the geometry
/// alone and prepared once. Not every arm that has one has six joints:
/// - seven: the first or the last is given its value, and the other six are solved;
/// - four or five: joints at the tool are added, which must come out at zero (spatial task), or
///   may have any value, as the roll of a tool that turns about its own axis (111110:tool);
/// - three and the position: a wrist is added that may have any value.
class ClosedForm {
 public:
  /// Empty when no loop of a known family is found. No mimic and no helical joints.
  static std::optional<ClosedForm> of(const Arm& arm, const Task& task);

  /// In words. Joints are counted as those of the arm; with a coordinate `missing`, as those of the
  /// arm that this one was made of by locking it.
  std::string family(int missing = -1) const {
    return description(loop_, locked_ == 0 ? 0 : missing);
  }

  /// The coordinate that has to be given: the first or the last of seven, else -1.
  int locked() const { return locked_; }

  /// Whether joints were added, whose share of a singular wrist's turn is not the arm's.
  bool has_added_joints() const { return dof_ < 6; }

  /// Whether some of these may have any value: solutions that differ by them are one.
  bool has_free_joints() const {
    return std::find(any_value_.begin(), any_value_.end(), true) != any_value_.end();
  }

  /// Metres: what rounding counts against.
  double size() const { return loop_.size; }

  /// A question with everything but the goal filled in: the seed, the bounds (of the arm's
  /// coordinates), which coordinates may be turned around, and the residual that rounding leaves
  /// or, where less, the tolerance.
  SixQuestion question(const ConfigurationRef& seed, const Configuration& lower,
                       const Configuration& upper, double tolerance = 1e-10) const;

  /// The branches at a goal, the locked coordinate at `locked_value`. `goal` is a rigid motion.
  void branches(const Pose& world_T_tool, double locked_value, SixQuestion& question,
                SixBranches& found) const;

  /// Lane `lane` of what was found, as a configuration.
  void configuration(const SixBranches& found, int lane, double locked_value,
                     Eigen::Ref<Configuration> q) const;

 private:
  SixLoop loop_;
  std::array<int, 6> coordinates_{};  ///< the arm's for each of the loop's; -1: an added joint
  std::array<bool, 6> any_value_{};   ///< added joints that the task leaves free
  int dof_ = 6;
  int locked_ = -1;
  Chain::Link locked_link_;
  Pose locked_before_ = Pose::Identity();  ///< from world (first) or its own frame (last) ...
  Pose locked_after_ = Pose::Identity();   ///< ... to where the six begin, or from it to the tool
};

}  // namespace beeline
