#include <algorithm>

#include <beeline/draw/arm_figure.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

/// The axis of a joint, a line in the world. For a prismatic joint, it is the line along which the
/// origin of its link frame moves.
struct Axis {
  bool slides = false;
  Vector3 direction, point;

  Vector3 nearest_to(const Vector3& p) const {
    return point + direction.dot(p - point) * direction;
  }
};

struct Feet {
  Vector3 on_first, on_second;
};

/// Returns the feet of the common perpendicular of two axes; for parallel axes, where it is not
/// unique, the feet of the perpendiculars through the origin of the link frame.
Feet link_feet(const Axis& first, const Axis& second, const Vector3& origin, double size) {
  const Feet beside_origin{first.nearest_to(origin), second.nearest_to(origin)};
  const double cosine = first.direction.dot(second.direction);
  const double sine_squared = 1 - cosine * cosine;
  if (sine_squared < 1e-6) return beside_origin;
  const Vector3 gap = second.point - first.point;
  const double along_first =
      (first.direction.dot(gap) - cosine * second.direction.dot(gap)) / sine_squared;
  const double along_second =
      (cosine * first.direction.dot(gap) - second.direction.dot(gap)) / sine_squared;
  const Feet feet{first.point + along_first * first.direction,
                  second.point + along_second * second.direction};
  // The common perpendicular of almost parallel axes may lie far outside the arm.
  const bool near = (feet.on_first - beside_origin.on_first).norm() <= size &&
                    (feet.on_second - beside_origin.on_second).norm() <= size;
  return near ? feet : beside_origin;
}

Axis axis_of(const Joint& joint, const Pose& world_T_link) {
  const Twist screw = adjoint(world_T_link, joint.screw);
  if (kind(joint) == JointKind::prismatic) {
    return {true, screw.head<3>(), world_T_link.translation()};
  }
  const Vector3 w = screw.tail<3>();
  Axis axis{false, w, w.cross(screw.head<3>())};
  axis.point = axis.nearest_to(world_T_link.translation());
  return axis;
}

}  // namespace

std::vector<Vector3> Skeleton::line() const {
  std::vector<Vector3> points{base};
  for (const SkeletonJoint& joint : joints) {
    points.push_back(joint.enter);
    points.push_back(joint.leave);
  }
  points.push_back(tool);
  return points;
}

double Skeleton::size() const {
  double farthest = 0;
  for (const Vector3& p : line()) farthest = std::max(farthest, (p - base).norm());
  return farthest;
}

Skeleton skeleton(const Arm& arm, const ConfigurationRef& q) {
  const std::vector<Pose> links = link_poses(arm, q);
  const std::size_t n = arm.joints().size();
  Skeleton bones;
  bones.base = links.front().translation();
  bones.tool = (links.back() * arm.tool()).translation();
  std::vector<Axis> axes;
  double size = (bones.tool - links.back().translation()).norm();
  for (std::size_t i = 0; i < n; ++i) {
    axes.push_back(axis_of(arm.joints()[i], links[i + 1]));
    size += (links[i + 1].translation() - links[i].translation()).norm();
    SkeletonJoint joint;
    joint.kind = kind(arm.joints()[i]);
    joint.direction = axes[i].direction.normalized();
    if (axes[i].slides) {
      joint.enter = (links[i] * arm.joints()[i].offset).translation();
      joint.leave = links[i + 1].translation();
    }
    bones.joints.push_back(joint);
  }
  for (std::size_t i = 0; i <= n; ++i) {  // link i, between joints i and i + 1
    SkeletonJoint* before = i > 0 && !axes[i - 1].slides ? &bones.joints[i - 1] : nullptr;
    SkeletonJoint* after = i < n && !axes[i].slides ? &bones.joints[i] : nullptr;
    if (before != nullptr && after != nullptr) {
      const Feet feet = link_feet(axes[i - 1], axes[i], links[i].translation(), size);
      before->leave = feet.on_first;
      after->enter = feet.on_second;
    } else if (before != nullptr) {
      before->leave = axes[i - 1].nearest_to(i < n ? bones.joints[i].enter : bones.tool);
    } else if (after != nullptr) {
      after->enter = axes[i].nearest_to(i > 0 ? bones.joints[i - 1].leave : bones.base);
    }
  }
  for (SkeletonJoint& joint : bones.joints) {
    const bool slides = joint.kind == JointKind::prismatic;
    joint.centre = slides ? joint.enter : Vector3((joint.enter + joint.leave) / 2);
  }
  return bones;
}

}  // namespace beeline
