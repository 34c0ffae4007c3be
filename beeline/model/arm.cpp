#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {
namespace {

constexpr double farthest = 1e100;  // metres; beyond, squares overflow
constexpr double rounding = 1e-9;   // of a screw's unit length and of parallel axes

void check_limits(const Limits& limits, const std::string& what) {
  if (std::isnan(limits.lower) || std::isnan(limits.upper))
    throw Error(what + " has a limit that is no number");
  if (limits.lower > limits.upper) {
    throw Error(what + " has its limits the wrong way round: lower " + number(limits.lower) +
                " is above upper " + number(limits.upper));
  }
  if (limits.lower == Limits::none || limits.upper == -Limits::none) {
    throw Error(what + " has limits " + number(limits.lower) + " to " + number(limits.upper) +
                "; no finite value lies between them");
  }
  for (double rate : {limits.velocity, limits.acceleration, limits.jerk}) {
    if (!(rate > 0)) {
      throw Error(what + " has a velocity, acceleration or jerk limit of " + number(rate) +
                  "; it must be above zero, or be left out");
    }
  }
}

void check_joint(Joint& joint, std::size_t index) {
  const std::string what =
      "joint " + std::to_string(index + 1) + (joint.name.empty() ? "" : " (" + joint.name + ")");
  if (joint.name.empty()) throw Error(what + " has no name");
  joint.offset = checked_pose(joint.offset, what + ": the offset");
  if (!joint.screw.allFinite()) throw Error(what + " has a screw that is not finite");
  if (joint.screw.cwiseAbs().maxCoeff() > farthest) {
    throw Error(what + " has a screw with a number above 1e100; no arm is that large");
  }
  const double turn = joint.screw.tail<3>().norm();
  const double unit = turn == 0 ? joint.screw.head<3>().norm() : turn;
  if (std::abs(unit - 1) > rounding) {
    throw Error(what + " has a screw of length " + number(unit) + "; it must be 1");
  }
  check_limits(joint.limits, what);
}

std::size_t leader_of(const std::vector<Joint>& joints,
                      const std::unordered_map<std::string, std::size_t>& index, std::size_t i) {
  const auto leader = index.find(joints[i].mimic->leader);
  if (leader != index.end()) return leader->second;
  std::vector<std::string> names;
  for (const Joint& joint : joints) names.push_back(joint.name);
  throw Error("joint " + joints[i].name + " mimics an " +
              unknown_name("joint", joints[i].mimic->leader, names).what());
}

/// A follower may lead others, in any order: each chain is climbed to where it is known, once.
std::vector<Arm::Drive> resolve_drives(const std::vector<Joint>& joints,
                                       const std::unordered_map<std::string, std::size_t>& index,
                                       const std::vector<int>& coordinate_of) {
  std::vector<Arm::Drive> drives(joints.size());
  std::vector<bool> known(joints.size(), false);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    std::vector<std::size_t> followers;
    std::size_t at = i;
    while (!known[at] && joints[at].mimic) {
      if (followers.size() == joints.size()) {
        throw Error("joint " + joints[i].name + " mimics itself in a circle");
      }
      followers.push_back(at);
      at = leader_of(joints, index, at);
    }
    if (!known[at]) drives[at].coordinate = coordinate_of[at];
    known[at] = true;
    for (; !followers.empty(); followers.pop_back()) {
      const Arm::Drive& leader = drives[at];
      at = followers.back();
      const Mimic& mimic = *joints[at].mimic;
      drives[at] = {leader.coordinate, mimic.multiplier * leader.ratio,
                    mimic.multiplier * leader.shift + mimic.offset};
      if (!std::isfinite(drives[at].ratio) || !std::isfinite(drives[at].shift)) {
        throw Error("joint " + joints[at].name + " mimics with a number that is not finite");
      }
      known[at] = true;
    }
  }
  return drives;
}

/// The leader's limits, narrowed so that a follower (`what`) stays within its own.
void narrow(Limits& leader, const Limits& follower, const Arm::Drive& drive,
            const std::string& what) {
  if (drive.ratio == 0) {  // the follower stands still
    if (drive.shift >= follower.lower && drive.shift <= follower.upper) return;
    throw Error(what + " stands at " + number(drive.shift) + ", outside its limits " +
                number(follower.lower) + " to " + number(follower.upper));
  }
  double lower = (follower.lower - drive.shift) / drive.ratio;
  double upper = (follower.upper - drive.shift) / drive.ratio;
  if (lower > upper) std::swap(lower, upper);
  leader.lower = std::max(leader.lower, lower);
  leader.upper = std::min(leader.upper, upper);
  leader.velocity = std::min(leader.velocity, follower.velocity / std::abs(drive.ratio));
  leader.acceleration =
      std::min(leader.acceleration, follower.acceleration / std::abs(drive.ratio));
  leader.jerk = std::min(leader.jerk, follower.jerk / std::abs(drive.ratio));
}

bool is_planar(const Arm& arm) {
  Pose base_T_link = arm.base();
  for (const Joint& joint : arm.joints()) {
    base_T_link = base_T_link * joint.offset;
    const Twist screw = adjoint(base_T_link, joint.screw);
    const bool turns_about_z = screw.segment<2>(3).isZero(rounding);
    const bool stays_in_plane = std::abs(screw[2]) < rounding;
    if (!turns_about_z || !stays_in_plane) return false;
  }
  const Vector3 tool_z = (base_T_link * arm.tool()).linear().col(2);
  return (tool_z - Vector3::UnitZ()).isZero(rounding);
}

/// The farthest that a joint of this kind can carry its link along its own travel.
double travel(const Joint& joint, const Limits& limits, const Arm::Drive& drive) {
  const double along = kind(joint) == JointKind::prismatic ? 1 : std::abs(pitch(joint));
  if (along == 0 || drive.ratio == 0) return along * std::abs(drive.shift);
  return along * std::max(std::abs(drive.ratio * limits.lower + drive.shift),
                          std::abs(drive.ratio * limits.upper + drive.shift));
}

/// The centre is a point of the first axis that turns. From there to the tool leads a chain of
/// points, one on each such axis: two neighbours are on one rigid link, so the distance between
/// them changes only by what slides between them. The radius is the sum of all of these.
Arm::Reach reach_ball(const Arm& arm) {
  Arm::Reach reach;
  Pose base_T_link = arm.base();
  bool turned = false;
  Vector3 last = Vector3::Zero();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    const Arm::Drive& drive = arm.drives()[i];
    base_T_link = base_T_link * joint.offset;
    reach.radius += travel(joint, arm.limits(drive.coordinate), drive);
    if (kind(joint) == JointKind::prismatic) continue;
    const Twist screw = adjoint(base_T_link, joint.screw);
    const Vector3 axis = screw.tail<3>();
    const Vector3 origin = base_T_link.translation();
    const Vector3 point = axis.cross(screw.head<3>()) + axis.dot(origin) * axis;
    if (turned) reach.radius += (point - last).norm();
    if (!turned) reach.centre = point;
    turned = true;
    last = point;
  }
  const Vector3 tool = (base_T_link * arm.tool()).translation();
  if (!turned) reach.centre = tool;
  if (turned) reach.radius += (tool - last).norm();
  return reach;
}

}  // namespace

Arm::Arm(std::string name, std::vector<Joint> joints, const Pose& tool, const Pose& base)
    : name_(std::move(name)), joints_(std::move(joints)) {
  if (joints_.empty()) throw Error("arm " + name_ + " has no joints; it needs at least one");
  base_ = checked_pose(base, "the base");
  tool_ = checked_pose(tool, "the tool");
  std::unordered_map<std::string, std::size_t> index;
  std::vector<int> coordinate_of(joints_.size(), -1);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    check_joint(joints_[i], i);
    if (!index.emplace(joints_[i].name, i).second) {
      throw Error("two joints are called " + joints_[i].name + "; each needs a name of its own");
    }
    if (joints_[i].mimic) continue;
    coordinate_of[i] = dof();
    leaders_.push_back(static_cast<int>(i));
    limits_.push_back(joints_[i].limits);
  }
  drives_ = resolve_drives(joints_, index, coordinate_of);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!joints_[i].mimic) continue;
    const std::string what = "mimic joint " + joints_[i].name;
    Limits& leader = limits_[drives_[i].coordinate];
    narrow(leader, joints_[i].limits, drives_[i], what);
    check_limits(leader, what + " with its leader");
  }
  chain_ = chain_of(*this);
  chain_angles_ = angles_of(chain_);
  planar_ = is_planar(*this);
  reach_ = reach_ball(*this);
}

std::vector<std::string> Arm::joint_names() const {
  std::vector<std::string> names;
  for (int k = 0; k < dof(); ++k) names.push_back(joint_of(k).name);
  return names;
}

Arm with_tool(const Arm& arm, const Pose& tool) {
  return {arm.name(), arm.joints(), tool, arm.base()};
}

void check_configuration(const Arm& arm, const ConfigurationRef& q) {
  if (q.size() != arm.dof()) {
    throw Error("arm " + arm.name() + " takes " + std::to_string(arm.dof()) + " joint values (" +
                listed(arm.joint_names()) + "), not " + std::to_string(q.size()));
  }
  for (int k = 0; k < arm.dof(); ++k) {
    if (!std::isfinite(q[k])) {
      throw Error("the value of joint " + arm.joint_of(k).name + " is " + number(q[k]) +
                  "; it must be a finite number");
    }
  }
}

std::vector<int> outside_limits(const Arm& arm, const ConfigurationRef& q, double slack) {
  check_configuration(arm, q);
  std::vector<int> outside;
  for (int k = 0; k < arm.dof(); ++k) {
    if (!within_position_limits(arm.limits(k), q[k], slack)) outside.push_back(k);
  }
  return outside;
}

std::vector<std::string> limit_violations(const Arm& arm, const ConfigurationRef& q, double slack) {
  std::vector<std::string> violations;
  for (const int k : outside_limits(arm, q, slack)) {
    const Joint& joint = arm.joint_of(k);
    const Limits& limits = arm.limits(k);
    violations.push_back("joint " + joint.name + " at " + with_unit(joint, q[k]) +
                         " is outside its limits " + with_unit(joint, limits.lower) + " to " +
                         with_unit(joint, limits.upper));
  }
  return violations;
}

Configuration middle_configuration(const Arm& arm) {
  Configuration q(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    const bool bounded = std::isfinite(limits.lower) && std::isfinite(limits.upper);
    q[k] = bounded ? std::midpoint(limits.lower, limits.upper)
                   : std::clamp(0.0, limits.lower, limits.upper);
  }
  return q;
}

}  // namespace beeline
