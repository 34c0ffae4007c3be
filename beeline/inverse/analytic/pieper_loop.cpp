#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include <beeline/inverse/analytic/pieper_loop.h>

namespace beeline::internal {
namespace {

bool parallel(const JointAxis& a, const JointAxis& b) {
  return a.direction.cross(b.direction).norm() < special;
}

/// Returns the intersection of two axes; nothing if they are parallel or skew.
std::optional<Vector3> intersection(const JointAxis& a, const JointAxis& b, double size) {
  const Vector3 normal = a.direction.cross(b.direction);
  const double sine = normal.norm();
  // The error of the point is the error of the axes divided by the sine.
  constexpr double min_sine = 1e-3;
  if (sine < min_sine) return std::nullopt;
  const Vector3 offset = b.point - a.point;
  if (std::abs(offset.dot(normal)) > special * size * sine) return std::nullopt;
  const double along = offset.cross(b.direction).dot(normal) / (sine * sine);
  return a.point + along * a.direction;
}

/// Returns the common point of three consecutive axes.
std::optional<Vector3> intersection(const JointAxis& a, const JointAxis& b, const JointAxis& c,
                                    double size) {
  const auto ab = intersection(a, b, size), bc = intersection(b, c, size);
  if (!ab || !bc || (*ab - *bc).norm() > special * size) return std::nullopt;
  return ab;
}

/// Sets the combination weight[0] (1) + weight[1] (2) of the two equations that is free of an
/// unknown, and the equation that gives this unknown afterwards.
void decouple_by(PieperLoop& loop, double weight_1, double weight_2, int second) {
  loop.weight[0] = weight_1;
  loop.weight[1] = weight_2;
  loop.second = second;
}

/// Finds the combination that is free of a revolute joint. The joint's coefficients in equation i
/// are the length v_i times (cos, sin) of the joint, rotated by a constant angle; v_2 is a length.
/// The combination exists if v_1 and v_2 are parallel vectors of the plane.
bool decouple_revolute(PieperLoop& loop, const Eigen::Vector2d& v1, const Eigen::Vector2d& v2) {
  if (v1.norm() < special) {
    decouple_by(loop, 1, 0, 1);
    return true;
  }
  const double determinant = v1[0] * v2[1] - v1[1] * v2[0];
  if (std::abs(determinant) > special * loop.size * v1.norm()) return false;
  decouple_by(loop, -v1.dot(v2) / v1.squaredNorm(), 1, 0);
  return true;
}

/// Finds the combination that is free of a prismatic joint. The first equation contains its
/// displacement times `cosine` (not at all in the parallel family, which compares directions), the
/// second also its square.
bool decouple_prismatic(PieperLoop& loop, double cosine) {
  decouple_by(loop, 1, 0, 1);
  return loop.family == PieperLoop::Family::parallel || std::abs(cosine) < special;
}

Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> matrix(const RigidMotion& k) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&k.rotation[0][0]);
}

Eigen::Map<const Vector3> vector(const RigidMotion& k) {
  return Eigen::Map<const Vector3>(k.translation);
}

/// Finds a combination without joint d, by K_e: axis e relative to axis d.
bool decouple_by_e(PieperLoop& loop) {
  const Vector3 z = matrix(loop.before[1]).col(2), t = vector(loop.before[1]);
  const bool decoupled = loop.prismatic[0] ? decouple_prismatic(loop, z.z())
                                           : decouple_revolute(loop, -z.head<2>(), t.head<2>());
  if (decoupled) loop.first = PieperLoop::First::w;
  return decoupled;
}

/// Finds a combination without joint f, by K_f: axis f relative to axis e.
bool decouple_by_f(PieperLoop& loop) {
  const Vector3 z = matrix(loop.before[2]).row(2);
  const Vector3 m = matrix(loop.before[2]).transpose() * vector(loop.before[2]);
  const bool decoupled = loop.prismatic[2] ? decouple_prismatic(loop, z.z())
                                           : decouple_revolute(loop, z.head<2>(), m.head<2>());
  if (decoupled) loop.first = PieperLoop::First::u;
  return decoupled;
}

/// Fills in first, weight and second. `for_goal`: whether the K that depends on the goal is known.
void decouple(PieperLoop& loop, bool for_goal) {
  if (loop.family == PieperLoop::Family::parallel && (loop.prismatic[0] || loop.prismatic[2])) {
    // The first equation contains the angle between axes, which a translation does not change.
    decouple_by(loop, 1, 0, 1);
    loop.first = loop.prismatic[0] ? PieperLoop::First::w : PieperLoop::First::u;
    return;
  }
  // Of a goal that has made axes e and f parallel, the first equation is of joint d alone. It
  // vanishes if axis d is parallel to them too, and would leave joint f undetermined by K_e.
  if (for_goal && loop.goal_index == 2 && decouple_by_f(loop)) return;
  // Otherwise only constants decide.
  if (loop.goal_index != 1 && decouple_by_e(loop)) return;
  if (loop.goal_index != 2) decouple_by_f(loop);
}

/// Returns the loop that starts at joint `d`, of all goals or of one.
PieperLoop loop_from(const Chain& chain, PieperLoop::Family family, int d, double size,
                     const Pose* world_T_tool) {
  PieperLoop loop;
  loop.family = family;
  loop.size = size;
  loop.tool = rigid_motion(chain.tool);
  loop.base = rigid_motion(chain.base);
  for (int i = 0; i < 6; ++i) {
    const int joint = (d + i) % 6;
    const Chain::Link& link = chain.links[joint];
    const bool prismatic = link.theta_per_q == 0;
    loop.order[i] = joint;
    Pose before = constant_transform(link);
    if (prismatic) before = before * Eigen::AngleAxisd(link.theta_offset, Vector3::UnitZ());
    // K before joint 1 is computed from the goal and the base, which takes joint 1's constant
    // angle.
    if (prismatic && joint == 0) {
      loop.base = rigid_motion(chain.base * Eigen::AngleAxisd(link.theta_offset, Vector3::UnitZ()));
    }
    loop.before[i] = rigid_motion(before);
    loop.sign[i] = prismatic ? link.d_per_q : link.theta_per_q;
    loop.offset[i] = prismatic ? 0 : link.theta_offset;
    if (i < 3) loop.prismatic[i] = prismatic;
    if (joint == 0) loop.goal_index = i;
    if (i < 4) continue;
    loop.sin_alpha[i - 4] = link.sin_alpha;
    loop.cos_alpha[i - 4] = link.cos_alpha;
    loop.height += link.translation.z();
  }
  if (world_T_tool != nullptr) {
    loop.before[loop.goal_index] =
        rigid_motion(chain.tool * world_T_tool->inverse(Eigen::Isometry) * chain.base);
  }
  decouple(loop, world_T_tool != nullptr);
  return loop;
}

/// Returns the cost of a loop; lower is better. A loop without a quartic comes first, then one
/// whose constants K_e, K_f do not depend on the goal.
int cost(const PieperLoop& loop) {
  const bool goal_inside = loop.goal_index == 1 || loop.goal_index == 2;
  return (loop.first == PieperLoop::First::neither ? 2 : 0) + (goal_inside ? 1 : 0);
}

/// Whether the loop can be solved. Joint e must be revolute. Without a decoupled equation d or f
/// must be revolute, because the quartic comes from cos^2 + sin^2 = 1 of one of them.
bool solvable(const PieperLoop& loop) {
  if (loop.prismatic[1]) return false;
  return loop.first != PieperLoop::First::neither || !(loop.prismatic[0] && loop.prismatic[2]);
}

}  // namespace

double size_of(const std::vector<JointAxis>& axes, const Pose& tool) {
  double size = tool.translation().norm();
  for (std::size_t i = 1; i < axes.size(); ++i) size += (axes[i].point - axes[i - 1].point).norm();
  return size > 0 ? size : 1;
}

std::optional<PieperLoop> pieper_loop(const Chain& chain, const Pose* world_T_tool) {
  const std::vector<JointAxis> axes = axes_of(chain);
  const double size = size_of(axes, chain.tool);
  std::optional<PieperLoop> best;
  const auto consider = [&](const std::vector<JointAxis>& link_axes, PieperLoop::Family family,
                            int d) {
    const PieperLoop loop =
        loop_from(chain_through(chain, link_axes), family, d, size, world_T_tool);
    if (solvable(loop) && (!best || cost(loop) < cost(*best))) best = loop;
  };
  const auto revolute = [&](int i) { return chain.links[i].theta_per_q != 0; };
  for (int a = 0; a < 4; ++a) {
    if (!revolute(a) || !revolute(a + 1) || !revolute(a + 2)) continue;
    std::vector<JointAxis> link_axes = axes;
    const int d = (a + 3) % 6;
    if (const auto point = intersection(axes[a], axes[a + 1], axes[a + 2], size)) {
      for (int i = a; i < a + 3; ++i) link_axes[i].point = *point;
      consider(link_axes, PieperLoop::Family::intersecting, d);
    }
    if (parallel(axes[a], axes[a + 1]) && parallel(axes[a + 1], axes[a + 2])) {
      for (int i = a + 1; i < a + 3; ++i) {
        if (link_axes[i].direction.dot(link_axes[a].direction) < 0) link_axes[i].direction *= -1;
      }
      consider(link_axes, PieperLoop::Family::parallel, d);
    }
  }
  return best;
}

std::string description(const PieperLoop& loop, int joints, std::optional<int> locked) {
  const bool intersecting = loop.family == PieperLoop::Family::intersecting;
  std::string numbers;
  int real = 0;
  for (int i = 3; i < 6; ++i) {
    const int k = loop.order[i];
    if (k >= joints) continue;
    numbers += (real++ > 0 ? ", " : "") + std::to_string(locked && k >= *locked ? k + 2 : k + 1);
  }
  std::string text = real == 0 ? "" : (real == 1 ? "joint " : "joints ") + numbers;
  if (real < 3) {
    text += (real == 0 ? "" : " and ") + std::to_string(3 - real) + " virtual at the tool";
  }
  return std::string(intersecting ? "three axes meet (" : "three parallel axes (") + text + ")";
}

}  // namespace beeline::internal
