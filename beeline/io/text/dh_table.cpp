#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/model/internal/dh_frames.h>
#include <beeline/model/internal/dh_row.h>

namespace beeline {
namespace {

using internal::DhFrames;
using internal::DhNormal;

/// Max error of an axis, rad and, for arms of up to a metre, m; and max rounding of the position of
/// a frame that is far away.
constexpr double max_axis_error = 5e-13;
constexpr double max_rounding = 1e-13;

/// The value with few digits, if it differs by rounding: 0.15005 rather than 0.15004999999999999.
double tidy(double value) {
  constexpr double rounding = 1e-15;
  constexpr int digits = 12;
  if (std::abs(value) < rounding) return 0;
  const double rounded = internal::rounded(value, digits);
  return std::abs(rounded - value) < rounding ? rounded : value;
}

/// The same of an angle, which may be a multiple of 90 degrees. -pi becomes pi.
double tidy_angle(double value) {
  constexpr double rounding = 1e-15;
  const double quarters = std::round(value / (std::numbers::pi / 2));
  if (quarters == -2 && value + std::numbers::pi < rounding) return std::numbers::pi;
  const double whole = quarters * (std::numbers::pi / 2);
  return std::abs(whole - value) < rounding ? whole + 0.0 : tidy(value);  // 0 rather than -0
}

/// The row from one frame to the next one. The pose of the next frame keeps the error of the row.
DhRow row_between(Pose& frame, const Pose& next, JointKind kind, DhConvention convention) {
  const Twist z = kind == JointKind::prismatic ? translation_screw(Vector3::UnitZ())
                                               : rotation_screw(Vector3::UnitZ());
  Joint joint;
  joint.offset = frame.inverse(Eigen::Isometry) * next;
  joint.screw = z;
  if (convention == DhConvention::standard) {
    joint.screw = adjoint(joint.offset.inverse(Eigen::Isometry), z);
  }
  constexpr double any = Limits::none;
  DhRow row = internal::dh_row(joint, convention, any).value_or(DhRow{.kind = kind});
  row = {tidy(row.a), tidy_angle(row.alpha), tidy(row.d), tidy_angle(row.theta), kind};
  frame = frame * dh_joint(row, convention).offset;
  return row;
}

/// The error of a joint's axis that has a row, rad or, per metre of the arm's size, m.
double axis_error(const Pose& base_T_frame, const internal::DhAxis& axis, double unit) {
  const Vector3 z = base_T_frame.linear().col(2);
  const Vector3 to = axis.point - base_T_frame.translation();
  const double distance = axis.slides ? 0 : (to - to.dot(axis.direction) * axis.direction).norm();
  return std::max((z - axis.direction).norm(), distance / unit);
}

DhFreedom freedom_of(const DhFrames& frames, std::size_t i) {
  if (i == 0 || i + 1 == frames.frames.size()) return DhFreedom::end;
  if (frames.axes[i - 1].slides || frames.axes[i].slides) return DhFreedom::line;
  switch (frames.normals[i - 1]) {
    case DhNormal::unique:
      return DhFreedom::none;
    case DhNormal::parallel:
      return DhFreedom::along_axis;
    case DhNormal::coincident:
      return DhFreedom::on_axis;
  }
  return DhFreedom::none;
}

/// The helical joints.
std::vector<DhMisfit> helical_joints(const Arm& arm) {
  std::vector<DhMisfit> found;
  for (const Joint& joint : arm.joints()) {
    if (kind(joint) == JointKind::helical) found.push_back({.joint = joint.name, .helical = true});
  }
  return found;
}

}  // namespace

std::string name(DhFreedom freedom) {
  constexpr internal::EnumNames<DhFreedom> names("freedom of a DH frame");
  return names.of(freedom);
}

std::string sentence(const DhMisfit& misfit) {
  if (misfit.helical) return misfit.joint + " is helical, which no row describes";
  return "the axis of " + misfit.joint +
         " is nearly parallel to the axis before it: their common normal is " +
         number(misfit.distance) + " m away, so that no row gives it without a larger error";
}

DhTable dh_table(const Arm& arm, DhConvention convention) {
  DhTable table{.convention = convention, .misfits = helical_joints(arm)};
  if (!table) return table;
  const DhFrames frames = internal::dh_frames(arm, convention);
  double unit = 1;
  for (const internal::DhAxis& axis : frames.axes) {
    unit = std::max(unit, (axis.point - frames.axes.front().point).norm());
  }
  table.base = arm.base() * frames.frames.front();
  Pose frame = frames.frames.front(), last = Pose::Identity();
  for (std::size_t i = 0; i < frames.axes.size(); ++i) {
    const Joint& joint = arm.joints()[i];
    const Pose before = frame;
    table.rows.push_back(row_between(frame, frames.frames[i + 1], kind(joint), convention));
    const bool standard = convention == DhConvention::standard;
    const double distance = i == 0 ? 0 : frames.distances[i - 1];
    constexpr double rounding = std::numeric_limits<double>::epsilon();
    if (axis_error(standard ? before : frame, frames.axes[i], unit) > max_axis_error ||
        rounding * distance > max_rounding * unit) {
      table.misfits.push_back({.joint = joint.name, .distance = distance});
    }
    last = last * joint.offset;
  }
  table.tool = frame.inverse(Eigen::Isometry) * (last * arm.tool());
  for (std::size_t i = 0; i < frames.frames.size(); ++i) {
    table.freedom.push_back(freedom_of(frames, i));
  }
  if (!table) table.rows.clear();
  return table;
}

}  // namespace beeline
