#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/random_fraction.h>
#include <beeline/math/revolution.h>
#include <beeline/model/arm.h>
#include <beeline/model/internal/chain.h>
#include <beeline/model/internal/joint_reason.h>
#include <beeline/model/internal/ranges.h>

namespace beeline {
namespace {

constexpr double rounding = 1e-9;  // of parallel axes

std::size_t leader_of(const std::vector<Joint>& joints,
                      const std::unordered_map<std::string, std::size_t>& index, std::size_t i) {
  const auto leader = index.find(joints[i].mimic->leader);
  if (leader != index.end()) return leader->second;
  std::vector<std::string> names;
  for (const Joint& joint : joints) names.push_back(joint.name);
  throw Error("joint " + joints[i].name + " mimics an " +
              unknown_name("joint", joints[i].mimic->leader, names).what());
}

/// For each coordinate, see Arm::periodic().
std::vector<char> periodic_coordinates(const std::vector<Joint>& joints,
                                       const std::vector<Arm::JointCoupling>& couplings,
                                       std::size_t count) {
  std::vector<char> periodic(count, 1);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const double ratio = couplings[i].ratio;
    const bool turns = kind(joints[i]) == JointKind::revolute && ratio == std::round(ratio);
    if (ratio != 0 && !turns) periodic[couplings[i].coordinate] = 0;
  }
  return periodic;
}

/// A mimic joint may lead others, in any order: each sequence of leaders is followed up to one that
/// is resolved, once.
std::vector<Arm::JointCoupling> resolve_couplings(
    const std::vector<Joint>& joints, const std::unordered_map<std::string, std::size_t>& index,
    const std::vector<int>& coordinate_of) {
  std::vector<Arm::JointCoupling> couplings(joints.size());
  std::vector<bool> known(joints.size(), false);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    std::vector<std::size_t> followers;
    std::size_t joint = i;
    while (!known[joint] && joints[joint].mimic) {
      if (followers.size() == joints.size()) {
        throw Error("joint " + joints[i].name + " mimics itself through its leaders");
      }
      followers.push_back(joint);
      joint = leader_of(joints, index, joint);
    }
    if (!known[joint]) couplings[joint].coordinate = coordinate_of[joint];
    known[joint] = true;
    for (; !followers.empty(); followers.pop_back()) {
      const Arm::JointCoupling& leader = couplings[joint];
      joint = followers.back();
      const Mimic& mimic = *joints[joint].mimic;
      couplings[joint] = {leader.coordinate, mimic.multiplier * leader.ratio,
                          mimic.multiplier * leader.shift + mimic.offset};
      internal::check_coupling(couplings[joint], joints[joint].name);
      known[joint] = true;
    }
  }
  return couplings;
}

/// Tightens the leader's limits so that a follower, called `what`, stays within its own.
void tighten(Limits& leader, const Limits& follower, const Arm::JointCoupling& coupling,
             const std::string& what) {
  if (coupling.ratio == 0) {  // the follower does not move
    if (coupling.shift >= follower.lower && coupling.shift <= follower.upper) return;
    throw Error(what + " is fixed at " + number(coupling.shift) + ", outside its limits " +
                number(follower.lower) + " to " + number(follower.upper));
  }
  double lower = (follower.lower - coupling.shift) / coupling.ratio;
  double upper = (follower.upper - coupling.shift) / coupling.ratio;
  if (lower > upper) std::swap(lower, upper);
  leader.lower = std::max(leader.lower, lower);
  leader.upper = std::min(leader.upper, upper);
  leader.velocity = std::min(leader.velocity, follower.velocity / std::abs(coupling.ratio));
  leader.acceleration =
      std::min(leader.acceleration, follower.acceleration / std::abs(coupling.ratio));
  leader.jerk = std::min(leader.jerk, follower.jerk / std::abs(coupling.ratio));
}

/// Whether all joints rotate about the world's z and, if `in_plane`, translate across it only, the
/// tool's z along it.
bool moves_about_z(const Arm& arm, bool in_plane) {
  Pose base_T_link = arm.base();
  for (const Joint& joint : arm.joints()) {
    base_T_link = base_T_link * joint.offset;
    const Twist screw = adjoint(base_T_link, joint.screw);
    if (!screw.segment<2>(3).isZero(rounding)) return false;
    if (in_plane && !(std::abs(screw[2]) < rounding)) return false;
  }
  const Vector3 tool_z = (base_T_link * arm.tool()).linear().col(2);
  return !in_plane || (tool_z - Vector3::UnitZ()).isZero(rounding);
}

/// Whether an angle is more than a revolution, and would be within the limits in degrees.
bool rather_in_degrees(const Limits& limits, double angle) {
  constexpr double degree = std::numbers::pi / 180;
  return std::abs(angle) > 2 * std::numbers::pi && angle * degree >= limits.lower &&
         angle * degree <= limits.upper;
}

/// The translations of a link along its joint's axis within the limits, metres: around `middle` by
/// up to `half`, which is infinite for a joint without limits.
struct Translations {
  double middle = 0, half = 0;
  double typical = 0;  ///< largest(), or if that is infinite, of one revolution

  double largest() const { return std::abs(middle) + half; }
};

Translations translations_of(const Joint& joint, const Limits& limits,
                             const Arm::JointCoupling& coupling) {
  const double along = kind(joint) == JointKind::prismatic ? 1 : pitch(joint);
  if (along == 0) return {};
  if (coupling.ratio == 0) {
    return {.middle = along * coupling.shift, .typical = std::abs(along * coupling.shift)};
  }
  const double a = along * (coupling.ratio * limits.lower + coupling.shift);
  const double b = along * (coupling.ratio * limits.upper + coupling.shift);
  if (!std::isfinite(a - b)) {
    const bool turns = kind(joint) != JointKind::prismatic;
    return {.half = Limits::none, .typical = turns ? internal::revolution * std::abs(along) : 0};
  }
  const double middle = a + (b - a) / 2;
  const double half = std::max(std::abs(a - middle), std::abs(b - middle));
  return {middle, half, std::abs(middle) + half};
}

/// The centre is a point on the first axis of rotation. A sequence of points, one on each axis of
/// rotation, leads from there to the tool: two neighbours are fixed to one link, so their distance
/// is constant except for the translations of joints between them. Prismatic joints before the
/// first axis of rotation, such as a rail, translate the whole arm: they are in the middle of their
/// ranges. The radius is the sum of all distances and translations; for the size they are typical.
Arm::Reach reach_ball(const Arm& arm) {
  Arm::Reach reach;
  Pose base_T_link = arm.base();
  bool rotates = false;
  Vector3 last = Vector3::Zero();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    const Translations along = translations_of(joint, arm.limits(coupling.coordinate), coupling);
    base_T_link = base_T_link * joint.offset;
    if (!rotates && kind(joint) == JointKind::prismatic) {
      base_T_link.translation() += base_T_link.linear() * joint.screw.head<3>() * along.middle;
      reach.radius += along.half;
      if (std::isfinite(along.half)) reach.size += along.half;
      continue;
    }
    reach.radius += along.largest();
    reach.size += along.typical;
    if (kind(joint) == JointKind::prismatic) continue;
    const Twist screw = adjoint(base_T_link, joint.screw);
    const Vector3 axis = screw.tail<3>();
    const Vector3 origin = base_T_link.translation();
    const Vector3 point = axis.cross(screw.head<3>()) + axis.dot(origin) * axis;
    const double distance = rotates ? (point - last).norm() : 0;
    reach.radius += distance;
    reach.size += distance;
    if (!rotates) reach.centre = point;
    rotates = true;
    last = point;
  }
  const Vector3 tool = (base_T_link * arm.tool()).translation();
  if (!rotates) reach.centre = tool;
  const double distance = rotates ? (tool - last).norm() : 0;
  reach.radius += distance;
  reach.size += distance;
  return reach;
}

/// Returns the arm with these joints, which differ from its own in limits only.
Arm with_joint_limits(const Arm& arm, std::vector<Joint> joints) {
  Arm limited(arm.name(), std::move(joints), arm.tool(), arm.base(), arm.controller());
  internal::ArmMemory::share(arm, /*same_tool=*/true, limited);
  return limited;
}

}  // namespace

Arm::Arm(std::string name, std::vector<Joint> joints, const Pose& tool, const Pose& base,
         const std::optional<ControllerFrames>& controller)
    : name_(std::move(name)), joints_(std::move(joints)) {
  internal::check_count(joints_.size(), name_);
  base_ = internal::checked_placement(base, "the base");
  tool_ = internal::checked_placement(tool, "the tool");
  controller_ = controller.value_or(
      ControllerFrames{.base_assumed = true, .flange = tool, .flange_assumed = true});
  controller_.base = internal::checked_placement(controller_.base, "the controller's base");
  controller_.flange = internal::checked_placement(controller_.flange, "the flange");
  std::unordered_map<std::string, std::size_t> index;
  std::vector<int> coordinate_of(joints_.size(), -1);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    internal::check_joint(joints_[i], i);
    if (!index.emplace(joints_[i].name, i).second) {
      throw Error("two joints are called " + joints_[i].name + "; each needs its own name");
    }
    if (joints_[i].mimic) continue;
    coordinate_of[i] = dof();
    leaders_.push_back(static_cast<int>(i));
    limits_.push_back(joints_[i].limits);
  }
  couplings_ = resolve_couplings(joints_, index, coordinate_of);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!joints_[i].mimic) continue;
    const std::string what = "mimic joint " + joints_[i].name;
    Limits& leader = limits_[couplings_[i].coordinate];
    tighten(leader, joints_[i].limits, couplings_[i], what);
    internal::check_limits(leader, what + " with its leader");
  }
  periodic_ = periodic_coordinates(joints_, couplings_, leaders_.size());
  internal::Chain chain = internal::make_chain(*this);
  internal::ChainAngles angles = internal::angles_of(chain);
  memory_ = Memory(new internal::ArmMemory(std::move(chain), std::move(angles)));
  planar_ = moves_about_z(*this, true);
  rotates_about_z_ = moves_about_z(*this, false);
  reach_ = reach_ball(*this);
}

Arm::Memory::Memory(const Memory& other) noexcept : memory_(other.memory_) {
  if (memory_ != nullptr) memory_->arms.fetch_add(1, std::memory_order_relaxed);
}
Arm::Memory::~Memory() {
  if (memory_ != nullptr && memory_->arms.fetch_sub(1, std::memory_order_acq_rel) == 1) {
    delete memory_;
  }
}

std::vector<std::string> Arm::joint_names() const {
  std::vector<std::string> names;
  for (int k = 0; k < dof(); ++k) names.push_back(joint_of(k).name);
  return names;
}

bool far_from(const Arm::Reach& sphere, double distance) {
  constexpr double far = 10;  // times the radius
  return distance > far * sphere.radius;
}

bool rather_in_millimetres(const Arm::Reach& sphere, const Vector3& position) {
  return far_from(sphere, (position - sphere.centre).norm()) &&
         (position / 1000 - sphere.centre).norm() <= sphere.radius;
}

Arm with_tool(const Arm& arm, const Pose& tool) {
  Arm other(arm.name(), arm.joints(), tool, arm.base(), arm.controller());
  internal::ArmMemory::share(arm, /*same_tool=*/false, other);
  return other;
}

Arm with_tcp(const Arm& arm, const Pose& tool_T_tcp) {
  return with_tool(arm, arm.tool() * checked_pose(tool_T_tcp, "the tool centre point"));
}

Arm with_mount(const Arm& arm, const Pose& world_T_mount) {
  const Pose mount = checked_pose(world_T_mount, "the mount");
  ControllerFrames controller = arm.controller();
  controller.base = mount * controller.base;
  return {arm.name(), arm.joints(), arm.tool(), mount * arm.base(), controller};
}

Arm with_limits(const Arm& arm, const std::map<std::string, LimitOverrides>& limits) {
  std::vector<Joint> joints = arm.joints();
  std::vector<std::string> names;
  for (const Joint& joint : joints) names.push_back(joint.name);
  for (const auto& [name, overrides] : limits) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw Error("limits for an " + std::string(unknown_name("joint", name, names).what()));
    }
    Joint& joint = joints[static_cast<std::size_t>(found - names.begin())];
    joint.limits = overridden(joint.limits, overrides);
  }
  return with_joint_limits(arm, std::move(joints));
}

Arm with_speed_scale(const Arm& arm, double k) {
  constexpr double min_scale = 1e-6;  // its cube scales the jerk and must remain far above rounding
  if (!(k >= min_scale && k <= 1)) {
    throw Error::of("speed_scale", "the speed scale must be from " + number(min_scale) +
                                       " to 1, not " + number(k));
  }
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    Limits& limits = joint.limits;
    const std::tuple<const char*, double&, double> rates[] = {
        {"velocity", limits.velocity, k},
        {"acceleration", limits.acceleration, k * k},
        {"jerk", limits.jerk, k * k * k}};
    for (const auto& [quantity, limit, factor] : rates) {
      limit *= factor;
      if (limit >= Limits::min_rate) continue;
      throw Error::of("speed_scale", "the speed scale " + number(k) + " is too small: the " +
                                         quantity + " limit of joint " + joint.name + " would be " +
                                         number(limit) + ", below " + number(Limits::min_rate));
    }
    limits.speed_scale *= k;
  }
  return with_joint_limits(arm, std::move(joints));
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

std::vector<Reason> limit_violations(const Arm& arm, const ConfigurationRef& q, double slack) {
  std::vector<Reason> violations;
  for (const int k : outside_limits(arm, q, slack)) {
    const Limits& limits = arm.limits(k);
    Reason outside = internal::joint_reason(ReasonCode::joint_outside_limits, arm.joint_of(k));
    outside.set(ReasonField::value, q[k]);
    outside.set(ReasonField::lower, limits.lower).set(ReasonField::upper, limits.upper);
    const bool revolute = kind(arm.joint_of(k)) == JointKind::revolute;
    if (revolute && rather_in_degrees(limits, q[k])) {
      outside.set(ReasonField::in_degrees, true);
    }
    violations.push_back(std::move(outside));
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

Configuration random_configuration(const Arm& arm, std::mt19937_64& engine) {
  Configuration q(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const double half = kind(arm.joint_of(k)) == JointKind::prismatic ? 1 : std::numbers::pi;
    auto [lower, upper] = std::pair(arm.limits(k).lower, arm.limits(k).upper);
    const bool below = std::isfinite(lower), above = std::isfinite(upper);
    if (!below) lower = above ? upper - 2 * half : -half;
    if (!above) upper = below ? lower + 2 * half : half;
    q[k] = std::min(upper, lower + (upper - lower) * internal::random_fraction(engine));
  }
  return q;
}

}  // namespace beeline
