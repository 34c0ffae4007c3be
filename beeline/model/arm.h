#pragma once

#include <string>
#include <vector>

#include <beeline/model/chain.h>
#include <beeline/model/joint.h>

namespace beeline {

/// The joint coordinates, one for each degree of freedom: radians, or metres where prismatic.
using Configuration = Eigen::VectorXd;
using ConfigurationRef = Eigen::Ref<const Eigen::VectorXd>;

/// A serial chain: base, joints 1 to n, tool. Immutable; checked when it is built.
/// Joint i connects link i-1 to link i; link 0 is the base.
class Arm {
 public:
  /// `base` is the pose of link 0 in the world, `tool` the tool's pose in link n.
  /// Throws Error for: no joints, two joints of one name, a number that is not finite, a screw that
  /// is not of unit length, an offset that is not a rigid motion, limits the wrong way round, a
  /// mimic joint whose leader is missing, follows in a circle or cannot keep it within its limits.
  Arm(std::string name, std::vector<Joint> joints, const Pose& tool = Pose::Identity(),
      const Pose& base = Pose::Identity());

  const std::string& name() const { return name_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const Pose& base() const { return base_; }
  const Pose& tool() const { return tool_; }

  /// The number of coordinates: every joint that is no mimic joint has one, in the arm's order.
  int dof() const { return static_cast<int>(leaders_.size()); }

  /// Coordinate k's joint. Its limits in `limits()` also keep its followers within theirs.
  const Joint& joint_of(Eigen::Index k) const { return joints_[leaders_[k]]; }
  const Limits& limits(Eigen::Index k) const { return limits_[k]; }
  const std::vector<Limits>& limits() const { return limits_; }
  std::vector<std::string> joint_names() const;  ///< one for each coordinate

  /// How joint i (from 0) is driven: its value is ratio * q[coordinate] + shift.
  struct Drive {
    int coordinate = 0;
    double ratio = 1;
    double shift = 0;
  };
  const std::vector<Drive>& drives() const { return drives_; }

  /// The same kinematics in the form that is fast to run through.
  const Chain& chain() const { return chain_; }
  const ChainAngles& chain_angles() const { return chain_angles_; }

  /// All motion stays in one plane z = constant, and the tool's z axis is the world's.
  bool planar() const { return planar_; }

  /// A ball in the world that the tool's origin never leaves, whatever the configuration within
  /// limits. The radius is infinite when a joint that slides has no limits.
  struct Reach {
    Vector3 centre = Vector3::Zero();
    double radius = 0;
  };
  const Reach& reach() const { return reach_; }

 private:
  std::string name_;
  std::vector<Joint> joints_;
  Pose base_, tool_;
  std::vector<int> leaders_;
  std::vector<Drive> drives_;
  std::vector<Limits> limits_;
  Chain chain_;
  ChainAngles chain_angles_;
  bool planar_ = false;
  Reach reach_;
};

/// A copy with another tool.
Arm with_tool(const Arm& arm, const Pose& tool);

/// Throws Error unless q has the arm's number of coordinates, all finite.
void check_configuration(const Arm& arm, const ConfigurationRef& q);

/// The coordinates of q that are outside their position limits by more than `slack` (rad or m).
/// Throws Error when q does not fit the arm.
std::vector<int> outside_limits(const Arm& arm, const ConfigurationRef& q,
                                double slack = position_slack);

/// One sentence for each of outside_limits(); empty when all are within.
std::vector<std::string> limit_violations(const Arm& arm, const ConfigurationRef& q,
                                          double slack = position_slack);

/// The middle of each coordinate's limits; where a side is unlimited, the value nearest to zero.
Configuration middle_configuration(const Arm& arm);

}  // namespace beeline
