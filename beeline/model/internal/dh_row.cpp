#include <algorithm>
#include <cmath>

#include <beeline/model/internal/dh_row.h>

namespace beeline::internal {

bool same_joint(const Joint& a, const Joint& b, double tolerance, double unit) {
  const bool rotations = (a.offset.linear() - b.offset.linear()).isZero(tolerance) &&
                         (a.screw.tail<3>() - b.screw.tail<3>()).isZero(tolerance);
  const bool slides = kind(a) == JointKind::prismatic;  // then the screw is a direction
  const double scale = std::max(unit, a.offset.translation().cwiseAbs().maxCoeff());
  const double lengths = zero_length * unit + tolerance * scale;
  return rotations && (a.offset.translation() - b.offset.translation()).isZero(lengths) &&
         (a.screw.head<3>() - b.screw.head<3>()).isZero(slides ? zero_length + tolerance : lengths);
}

double length_unit(const Arm& arm) {
  double largest = std::max(arm.base().translation().cwiseAbs().maxCoeff(),
                            arm.tool().translation().cwiseAbs().maxCoeff());
  for (const Joint& joint : arm.joints()) {
    largest = std::max(largest, joint.offset.translation().cwiseAbs().maxCoeff());
    if (kind(joint) == JointKind::prismatic) continue;
    largest = std::max(largest, joint.screw.head<3>().cwiseAbs().maxCoeff());
  }
  return std::min(1.0, largest);
}

std::optional<DhRow> dh_row(const Joint& joint, DhConvention convention, double tolerance,
                            double unit) {
  const JointKind joint_kind = kind(joint);
  if (joint_kind == JointKind::helical) return std::nullopt;
  const bool prismatic = joint_kind == JointKind::prismatic;
  const Eigen::Matrix3d r = joint.offset.linear();
  const Vector3 t = joint.offset.translation();
  DhRow row{.kind = joint_kind};
  if (convention == DhConvention::modified) {
    row.alpha = std::atan2(-r(1, 2), r(2, 2));
    row.theta = std::atan2(-r(0, 1), r(0, 0));
    row.a = t.x();
    row.d = t.z() * std::cos(row.alpha) - t.y() * std::sin(row.alpha);
  } else {
    const Vector3 axis = prismatic ? joint.screw.head<3>() : joint.screw.tail<3>();
    row.alpha = std::atan2(axis.y(), axis.z());
    row.theta = std::atan2(r(1, 0), r(0, 0));
    row.a = t.x() * std::cos(row.theta) + t.y() * std::sin(row.theta);
    row.d = t.z();
  }
  if (!same_joint(joint, dh_joint(row, convention), tolerance, unit)) return std::nullopt;
  return row;
}

}  // namespace beeline::internal
