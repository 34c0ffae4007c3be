#pragma once

#include <initializer_list>
#include <iosfwd>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se3.h>
#include <beeline/reason.h>

namespace beeline {
namespace internal {
struct ArmMemory;
}

/// The joint coordinates, one for each degree of freedom: rad, or m for a prismatic joint.
using Configuration = Eigen::VectorXd;

/// A configuration as an argument: an Eigen vector or expression, a braced list {0, -0.8, 1.2}, a
/// std::vector<double> or a std::span<const double>. It refers to the caller's numbers, so it is
/// not to be stored.
class ConfigurationRef : public Eigen::Ref<const Configuration> {
 public:
  using Base = Eigen::Ref<const Configuration>;

  template <class Derived>
  requires std::is_same_v<typename Derived::Scalar, double> ConfigurationRef(
      const Eigen::DenseBase<Derived>& q)
      : Base(q.derived()) {}                   // NOLINT: implicit
  ConfigurationRef(std::span<const double> q)  // NOLINT: implicit
      : Base(Eigen::Map<const Configuration>(q.data(), static_cast<Eigen::Index>(q.size()))) {}
  ConfigurationRef(const std::vector<double>& q)  // NOLINT: implicit
      : ConfigurationRef(std::span<const double>(q)) {}
  ConfigurationRef(std::initializer_list<double> q)  // NOLINT: implicit
      : ConfigurationRef(std::span<const double>(q.begin(), q.size())) {}
};

/// The frames in which a robot's controller takes poses and tools.
struct ControllerFrames {
  /// Pose of the controller's root frame in the world: $ROBROOT of KUKA, the base frame of ABB and
  /// of Universal Robots.
  Pose base = Pose::Identity();
  /// Whether no description states `base`. It is then the world in which the arm is described.
  bool base_assumed = false;
  /// Pose in link n of the robot's mounting flange, the frame that tools are given in.
  Pose flange = Pose::Identity();
  /// Whether no description states `flange`. It is then the tool with which the arm is described.
  bool flange_assumed = false;
};

/// A serial chain: a base, joints 1 to n, a tool. Immutable, and checked on construction. Joint i
/// connects link i-1 to link i; link 0 is the base.
class Arm {
 public:
  /// `base` is the pose of link 0 in the world, `tool` the pose of the tool in link n. Without
  /// `controller` the root frame is assumed to be the world, and the flange the tool.
  /// Throws Error for: no joints; two joints of one name; a number that is not finite; a screw that
  /// is not of unit length; an offset, base, tool or controller frame that is not a rigid motion; a
  /// lower limit above the upper one; a velocity, acceleration or jerk limit below
  /// Limits::min_rate; a mimic joint whose leader does not exist, depends on itself, or cannot keep
  /// it within its limits.
  Arm(std::string name, std::vector<Joint> joints, const Pose& tool = Pose::Identity(),
      const Pose& base = Pose::Identity(),
      const std::optional<ControllerFrames>& controller = std::nullopt);

  const std::string& name() const { return name_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const Pose& base() const { return base_; }
  const Pose& tool() const { return tool_; }
  const ControllerFrames& controller() const { return controller_; }

  /// The number of coordinates. Every joint except the mimic joints has one, in the arm's order.
  int dof() const { return static_cast<int>(leaders_.size()); }

  /// The joint of coordinate k (from 0).
  const Joint& joint_of(Eigen::Index k) const { return joints_[leaders_[k]]; }
  std::vector<std::string> joint_names() const;  ///< names of the joints that have a coordinate

  /// The limits of coordinate k: the limits of its joint, tightened so that the mimic joints that
  /// follow it stay within their own limits.
  const Limits& limits(Eigen::Index k) const { return limits_[k]; }
  const std::vector<Limits>& limits() const { return limits_; }

  /// The dependence of a joint's value on q: ratio * q[coordinate] + shift.
  struct JointCoupling {
    int coordinate = 0;
    double ratio = 1;
    double shift = 0;
  };
  /// One for each joint.
  const std::vector<JointCoupling>& couplings() const { return couplings_; }

  /// Whether adding 2 pi to coordinate k leaves the posture unchanged: its joint is revolute, and
  /// so are all joints that follow it, with integer ratios.
  bool periodic(Eigen::Index k) const { return periodic_[k]; }

  /// Whether all motion is in one plane z = constant, with the tool's z axis along the world's.
  bool planar() const { return planar_; }

  /// Whether all axes of rotation are parallel to the world's z axis. True for planar arms and
  /// SCARAs.
  bool rotates_about_z() const { return rotates_about_z_; }

  /// A sphere in the world that contains the tool's origin in every configuration within the
  /// limits. Its radius is infinite when a prismatic or helical joint has no position limits.
  struct Reach {
    Vector3 centre = Vector3::Zero();
    double radius = 0;
    /// The radius without travels that have no limits, except of one revolution of helical joints.
    double size = 0;
  };
  const Reach& reach() const { return reach_; }

 private:
  friend struct internal::ArmMemory;

  /// What follows from the arm. The library computes each part when it is first needed; copies of
  /// the arm share it, and the last one frees it.
  class Memory {
   public:
    Memory() = default;
    explicit Memory(internal::ArmMemory* memory) : memory_(memory) {}
    Memory(const Memory& other) noexcept;
    Memory(Memory&& other) noexcept : memory_(std::exchange(other.memory_, nullptr)) {}
    Memory& operator=(Memory other) noexcept {
      std::swap(memory_, other.memory_);
      return *this;
    }
    ~Memory();

    internal::ArmMemory& operator*() const { return *memory_; }

   private:
    internal::ArmMemory* memory_ = nullptr;
  };

  std::string name_;
  std::vector<Joint> joints_;
  Pose base_, tool_;
  ControllerFrames controller_;
  std::vector<int> leaders_;
  std::vector<JointCoupling> couplings_;
  std::vector<Limits> limits_;
  std::vector<char> periodic_;  // a bool each
  Memory memory_;
  bool planar_ = false;
  bool rotates_about_z_ = false;
  Reach reach_;
};

/// Whether this distance from the sphere's centre, m, is more than ten times the sphere's radius:
/// what is so far away has no influence on the arm, or its unit is not the metre.
bool far_from(const Arm::Reach& sphere, double distance);

/// Whether a position is probably in millimetres: far from the sphere, and within it if read in
/// millimetres.
bool rather_in_millimetres(const Arm::Reach& sphere, const Vector3& position);

/// Returns the arm of a Denavit-Hartenberg table: one joint for each row, named joint1, joint2 and
/// so on, with `limits`, one for each row, or none. Throws Error as dh_joint() and Arm do, and for
/// another number of limits.
Arm arm_from_dh(const std::string& name, std::span<const DhRow> rows, DhConvention convention,
                std::span<const Limits> limits = {});

/// The frame in which screws are given, at zero joint values.
enum class ScrewFrame {
  space,  ///< the world
  body,   ///< the tool
};

/// Returns the arm of a product of exponentials (Lynch & Park, sections 4.1.1 and 4.1.3),
///   T(q) = exp(S1 q1) ... exp(Sn qn) M = M exp(B1 q1) ... exp(Bn qn):
/// one joint for each screw S (space) or B (body), named joint1, joint2 and so on, with `limits`,
/// one for each, or none. A screw is a twist [vx vy vz wx wy wz]: of a rotation |w| = 1 and v =
/// point x w + pitch w, of a translation w = 0 and |v| = 1. `home` is M, the pose of the tool in
/// the world at zero joint values. The frame of link i has the directions of the world's axes and
/// its origin on the joint's axis, nearest to the origin of the link before.
/// Lengths that differ from 1 by up to 0.001 are rounded numbers: the screw is divided by them.
/// Throws Error as Arm does, for other lengths, for a pitch that may come from the decimals to
/// which the numbers are rounded, and for another number of limits.
Arm arm_from_screws(const std::string& name, std::span<const Twist> screws, const Pose& home,
                    ScrewFrame frame, std::span<const Limits> limits = {});

/// Returns the screws of all joints and the pose of the tool in the world, at zero joint values:
/// what arm_from_screws() takes.
std::vector<Twist> screws(const Arm& arm, ScrewFrame frame);
Pose home_pose(const Arm& arm);

/// Returns a copy with another tool on the same flange.
Arm with_tool(const Arm& arm, const Pose& tool);

/// Returns a copy with a tool centre point (TCP): the new tool frame has the pose `tool_T_tcp` in
/// the old tool frame, which is the flange of an arm described without a tool.
Arm with_tcp(const Arm& arm, const Pose& tool_T_tcp);

/// Returns a copy mounted in the world: the frame that was the world has the pose `world_T_mount`
/// in the new world. The controller's root frame moves with the arm.
Arm with_mount(const Arm& arm, const Pose& world_T_mount);

/// Returns a copy in which the joints with these names have these limits. Throws Error for the name
/// of a joint that the arm does not have, and for limits that Arm refuses.
Arm with_limits(const Arm& arm, const std::map<std::string, LimitOverrides>& limits);

/// Returns a copy with the speed scale k from 1e-6 to 1: velocity limits are multiplied by k,
/// acceleration limits by k^2, jerk limits by k^3, so a motion at its limits takes 1/k of the time
/// on the same path (Lynch & Park, section 9.1). Unknown limits remain unknown; the limits that a
/// motion assumes instead are scaled too. Throws Error for another k, and when a
/// limit would be below Limits::min_rate.
Arm with_speed_scale(const Arm& arm, double k);

/// Returns whether the joints of both arms carry the links in the same way, from bases at the same
/// pose. Limits, names and tools may differ.
bool same_links(const Arm& a, const Arm& b);

/// The same for arms whose bases may be at different poses.
bool same_joints(const Arm& a, const Arm& b);

/// Throws Error unless q has arm.dof() values, all finite.
void check_configuration(const Arm& arm, const ConfigurationRef& q);

/// Returns the coordinates of q that violate their position limits by more than `slack` (rad or m).
/// Throws Error when q does not fit the arm.
std::vector<int> outside_limits(const Arm& arm, const ConfigurationRef& q,
                                double slack = position_slack);

/// Returns a reason, joint_outside_limits, for each of outside_limits().
std::vector<Reason> limit_violations(const Arm& arm, const ConfigurationRef& q,
                                     double slack = position_slack);

/// The midpoint of each coordinate's limits, or the value nearest to zero if a limit is infinite.
Configuration middle_configuration(const Arm& arm);

/// Returns a configuration from the uniform distribution within the position limits. A coordinate
/// with one limit is within one revolution or two metres of it. A coordinate without limits is
/// within half a revolution or one metre of zero. An engine with the same seed gives the same
/// configurations on every machine.
Configuration random_configuration(const Arm& arm, std::mt19937_64& engine);

/// Returns the limits of joint i (from 0): a mimic joint's own limits, otherwise the limits of its
/// coordinate.
inline const Limits& joint_limits(const Arm& arm, std::size_t i) {
  const Joint& joint = arm.joints()[i];
  return joint.mimic ? joint.limits : arm.limits(arm.couplings()[i].coordinate);
}

/// Returns the arm as a table. For each joint it has the kind, the axis in the world with all
/// joints at 0, the position limits, and the limits of velocity, acceleration and jerk, with a mark
/// at the values that motion_limits() assumes. It also has the frames of all links and of the tool
/// with all joints at 0, and the reach. Numbers have six significant digits; angles are in rad or
/// in degrees.
std::string arm_table(const Arm& arm, bool degrees = false);

/// Prints arm_table().
std::ostream& operator<<(std::ostream& out, const Arm& arm);

}  // namespace beeline
