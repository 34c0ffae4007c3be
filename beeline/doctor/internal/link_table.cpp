#include <algorithm>
#include <cmath>

#include <beeline/doctor/internal/link_table.h>
#include <beeline/model/internal/joint_axes.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

constexpr double nearly_parallel = 1e-3;  // sine
constexpr double coincident = 1e-6;       // metres

bool parallel(const JointLine& a, const JointLine& b) {
  return a.direction.cross(b.direction).norm() < nearly_parallel;
}

/// The point of the line where it crosses the plane through `point` with the normal `normal`.
Vector3 in_plane(const JointLine& line, const Vector3& point, const Vector3& normal) {
  return line.point +
         (point - line.point).dot(normal) / line.direction.dot(normal) * line.direction;
}

/// The link between two axes: the frame on the first one at the foot of the common normal, whose x
/// axis is the normal, and the point on the second one.
struct Link {
  Pose world_T_link;
  Vector3 next;
};

/// `before` is the frame of the first joint at the end of the previous link.
Link link_between(const JointLine& from, JointLine to, const Pose& before) {
  const Vector3 z = from.direction;
  if (to.kind == JointKind::prismatic) to.point = before.translation();
  if (!parallel(from, to)) {
    const Vector3 x = z.cross(to.direction).normalized();
    return {frame_along(x, z, foot_of_normal(from, to)), foot_of_normal(to, from)};
  }
  const Vector3 next = in_plane(to, before.translation(), z);
  const Vector3 offset = next - before.translation();
  const Vector3 x =
      offset.norm() > coincident ? Vector3(offset.normalized()) : Vector3(before.linear().col(0));
  return {frame_along(x, z, before.translation()), next};
}

/// Fills in the constants of a link and returns the frame at its end.
Pose add_link(const Link& link, const Vector3& direction, LinkTable::Row& row) {
  const Vector3 offset =
      link.world_T_link.linear().transpose() * (link.next - link.world_T_link.translation());
  const Vector3 z = link.world_T_link.linear().transpose() * direction;
  row.a = offset.x();
  row.alpha = std::atan2(-z.y(), z.z());
  row.beta = std::asin(std::clamp(z.x(), -1.0, 1.0));
  Pose end = link.world_T_link;
  end.linear() = end.linear() * Eigen::AngleAxisd(row.alpha, Vector3::UnitX()) *
                 Eigen::AngleAxisd(row.beta, Vector3::UnitY());
  end.translation() = link.next;
  return end;
}

/// Returns the foot on the axis `from` of the frame for a prismatic axis `slide` that follows it.
/// At this height, the slide through the frame meets the axis `next`. If the height is not
/// determined, returns the foot of the common normal with `next`.
Vector3 foot_before_slide(const JointLine& from, const JointLine& slide, const JointLine& next) {
  constexpr double well_determined = 0.1;  // cosine
  const Vector3 normal = slide.direction.cross(next.direction).normalized();
  const double slope = normal.dot(from.direction);
  if (!(std::abs(slope) > well_determined)) return foot_of_normal(from, next);
  return from.point + (next.point - from.point).dot(normal) / slope * from.direction;
}

/// Returns the frame of the first axis before its motion. If the first two axes are not parallel,
/// it is at the foot of the first normal. For consecutive parallel axes that end at an axis k, it
/// is at the height with d_k = 0. For parallel axes only, it is at the height of the world's
/// origin.
Pose first_frame(const std::vector<JointLine>& lines) {
  const JointLine& first = lines[0];
  Vector3 origin = first.point - first.point.dot(first.direction) * first.direction;
  Pose before = frame_along(first.direction.unitOrthogonal(), first.direction, origin);
  if (lines.size() == 1) return before;
  std::size_t k = 0;
  while (k + 1 < lines.size() && parallel(lines[k], lines[k + 1])) ++k;
  std::size_t next = k + 1;
  while (next < lines.size() &&
         (lines[next].kind == JointKind::prismatic || parallel(lines[k], lines[next]))) {
    ++next;
  }
  if (next < lines.size()) {
    const Vector3 foot = next == k + 2 && lines[k + 1].kind == JointKind::prismatic
                             ? foot_before_slide(lines[k], lines[k + 1], lines[next])
                             : foot_of_normal(lines[k], lines[next]);
    origin = first.point + (foot - first.point).dot(first.direction) * first.direction;
  }
  before.translation() = origin;
  const Link link = link_between(first, lines[1], before);
  return k == 0 || (link.next - origin).norm() > coincident ? link.world_T_link : before;
}

/// Moves the prismatic axes at the beginning to the first frame of the others.
std::vector<JointLine> placed(std::vector<JointLine> lines) {
  std::size_t slides = 0;
  while (slides < lines.size() && lines[slides].kind == JointKind::prismatic) ++slides;
  if (slides == 0) return lines;
  const std::vector<JointLine> others(lines.begin() + static_cast<std::ptrdiff_t>(slides),
                                      lines.end());
  const Vector3 point =
      others.empty() ? Vector3(Vector3::Zero()) : Vector3(first_frame(others).translation());
  for (std::size_t i = 0; i < slides; ++i) lines[i].point = point;
  return lines;
}

Pose joint_frame(const Pose& before, const LinkTable::Row& row) {
  return before * Eigen::AngleAxisd(row.theta, Vector3::UnitZ()) *
         Eigen::Translation3d(0, 0, row.d);
}

Pose link_frame(const LinkTable::Row& row) {
  return Eigen::Translation3d(row.a, 0, 0) * Eigen::AngleAxisd(row.alpha, Vector3::UnitX()) *
         Pose(Eigen::AngleAxisd(row.beta, Vector3::UnitY()));
}

Twist screw_of(JointKind kind, const Vector3& direction, const Vector3& point, double pitch) {
  return kind == JointKind::prismatic ? translation_screw(direction)
                                      : rotation_screw(direction, point, pitch);
}

Joint joint_like(const Joint& named, const Pose& offset, const Twist& screw) {
  Joint joint;
  joint.name = named.name;
  joint.limits = named.limits;
  joint.offset = offset;
  joint.screw = screw;
  return joint;
}

}  // namespace

Vector3 foot_of_normal(const JointLine& a, const JointLine& b) {
  const Vector3 normal = a.direction.cross(b.direction);
  const double along = (b.point - a.point).cross(b.direction).dot(normal) / normal.squaredNorm();
  return a.point + along * a.direction;
}

std::vector<JointLine> joint_lines(const Arm& arm) {
  std::vector<JointLine> lines;
  Pose world_T_link = arm.base();
  for (const Joint& joint : arm.joints()) {
    world_T_link = world_T_link * joint.offset;
    const Twist screw = adjoint(world_T_link, joint.screw);
    const Vector3 v = screw.head<3>(), w = screw.tail<3>();
    JointLine line{.kind = kind(joint), .point = world_T_link.translation(), .pitch = pitch(joint)};
    line.direction = (line.kind == JointKind::prismatic ? v : w).normalized();
    // This is the point nearest to the link's origin, so that no digits are lost.
    if (line.kind != JointKind::prismatic) {
      line.point += w.cross(v + w.cross(world_T_link.translation()));
    }
    lines.push_back(line);
  }
  return lines;
}

Arm arm_along(const std::vector<JointLine>& lines, const Pose& world_T_tool, const Arm& named) {
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const JointLine& line = lines[i];
    joints.push_back(joint_like(named.joints()[i], Pose::Identity(),
                                screw_of(line.kind, line.direction, line.point, line.pitch)));
  }
  return {named.name(), joints, world_T_tool};
}

LinkTable link_table(const std::vector<JointLine>& anywhere, const Pose& world_T_tool) {
  const std::vector<JointLine> lines = placed(anywhere);
  LinkTable table;
  table.base = first_frame(lines);
  Pose before = table.base;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    LinkTable::Row row{.kind = lines[i].kind, .pitch = lines[i].pitch};
    if (i + 1 < lines.size()) {
      row.parallel = parallel(lines[i], lines[i + 1]);
      const Link link = link_between(lines[i], lines[i + 1], before);
      const Pose difference = before.inverse(Eigen::Isometry) * link.world_T_link;
      row.theta = std::atan2(difference(1, 0), difference(0, 0));
      row.d = difference.translation().z();
      before = add_link(link, lines[i + 1].direction, row);
    }
    table.rows.push_back(row);
  }
  table.tool = before.inverse(Eigen::Isometry) * world_T_tool;
  return table;
}

Arm arm_of(const LinkTable& table, const Arm& named) {
  std::vector<Joint> joints;
  Pose fixed = Pose::Identity();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const LinkTable::Row& row = table.rows[i];
    joints.push_back(joint_like(named.joints()[i], joint_frame(fixed, row),
                                screw_of(row.kind, Vector3::UnitZ(), Vector3::Zero(), row.pitch)));
    fixed = link_frame(row);
  }
  return {named.name(), joints, table.tool, table.base};
}

}  // namespace beeline::internal
