#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

/// What one joint contributes to a step, half-way.
struct Contribution {
  Vector3 turn;       ///< W_j
  Vector3 move;       ///< m_j
  double angle = 0;   ///< |W_j|, the same all the way
  double reach = 0;   ///< |m_j| at its largest on the way
  double behind = 0;  ///< sum_{k>=j} of these
};

std::vector<Contribution> contributions(const Arm& arm, const ConfigurationRef& q_a,
                                        const ConfigurationRef& q_b) {
  const std::vector<Pose> world_T_link = link_poses(arm, (q_a + q_b) / 2);
  const Vector3 tool = (world_T_link.back() * arm.tool()).translation();
  std::vector<Contribution> parts(arm.joints().size());
  double behind = 0;
  for (std::size_t i = parts.size(); i-- > 0;) {
    const Arm::Drive& drive = arm.drives()[i];
    const double step = drive.ratio * (q_b[drive.coordinate] - q_a[drive.coordinate]);
    const Twist velocity = joint_velocity(arm.joints()[i], world_T_link[i + 1], tool);
    Contribution& part = parts[i];
    part.turn = step * velocity.tail<3>();
    part.move = step * velocity.head<3>();
    part.angle = part.turn.norm();
    part.reach = part.move.norm() + part.angle * behind / 2;
    part.behind = behind += part.reach;
  }
  return parts;
}

}  // namespace

ChordBound chord_bound(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b) {
  check_configuration(arm, q_a);
  check_configuration(arm, q_b);
  ChordBound bound;
  Vector3 before = Vector3::Zero();                         // B_j
  Vector3 bend = Vector3::Zero(), swing = Vector3::Zero();  // p'', w'
  double before_change = 0;                                 // |B_j'|
  double bend_change = 0, swing_change = 0;                 // |p'''|, |w''|
  double bend_size = 0, swing_size = 0;  // |p''|, |w'| all the way, by sizes alone
  for (const Contribution& part : contributions(arm, q_a, q_b)) {
    const double turned = bound.turned;  // |B_j| at most
    bend += (part.turn + 2 * before).cross(part.move);
    swing += before.cross(part.turn);
    const double own_change = turned * part.angle;
    const double move_change = turned * part.reach + part.angle * part.behind;
    bend_change +=
        (own_change + 2 * before_change) * part.reach + (part.angle + 2 * turned) * move_change;
    swing_change += before_change * part.angle + turned * own_change;
    bend_size += (part.angle + 2 * turned) * part.reach;
    swing_size += turned * part.angle;
    before += part.turn;
    before_change += own_change;
    bound.moved += part.reach;
    bound.turned += part.angle;
  }
  bound.bend = bend / 8;
  bound.rest = bend_change / 48;
  bound.position = std::min(bound.bend.norm() + bound.rest, bend_size / 8);
  bound.swing = arm.planar() ? Vector3::Zero() : swing;
  bound.swing_rest = arm.planar() ? 0 : swing_change / 6;
  const double largest = std::min(bound.swing.norm() + bound.swing_rest, swing_size);
  bound.orientation = orientation_bound(arm.planar() ? 0 : largest, bound.turned);
  return bound;
}

double orientation_bound(double acceleration, double rotated) {
  using std::numbers::pi;
  if (!(rotated < pi)) return pi;
  const double k = rotated * std::numbers::inv_sqrtpi;
  return std::min(pi, acceleration / 8 * (k > 0 ? k / std::sin(k) : 1));
}

}  // namespace beeline
