#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/motion/chord.h>

namespace beeline {
namespace {

/// What one joint contributes to a step: only sizes matter, not signs and directions.
struct Contribution {
  double turn = 0;    ///< |dq| of a joint that turns, radians
  double slide = 0;   ///< |dq| of travel along the axis, metres
  double radius = 0;  ///< the tool's largest distance from the axis during the motion
};

std::vector<Contribution> contributions(const Arm& arm, const ConfigurationRef& q_a,
                                        const ConfigurationRef& q_b) {
  const std::vector<Pose> world_T_link = link_poses(arm, q_a);
  const Vector3 tool = (world_T_link.back() * arm.tool()).translation();
  std::vector<Contribution> parts(arm.joints().size());
  double carried = 0;  // how far the joints behind this one can move the tool
  for (std::size_t i = parts.size(); i-- > 0;) {
    const Arm::Drive& drive = arm.drives()[i];
    const double step = std::abs(drive.ratio * (q_b[drive.coordinate] - q_a[drive.coordinate]));
    const Twist screw = adjoint(world_T_link[i + 1], arm.joints()[i].screw);
    const Vector3 axis = screw.tail<3>();
    if (axis.isZero(0)) {
      parts[i].slide = step;
    } else {
      const double along = axis.dot(screw.head<3>());
      const Vector3 around = screw.head<3>() + axis.cross(tool) - along * axis;
      parts[i] = {step, std::abs(along) * step, around.norm() + carried};
    }
    carried += parts[i].slide + parts[i].radius * parts[i].turn;
  }
  return parts;
}

}  // namespace

ChordBound chord_bound(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b) {
  using std::numbers::inv_sqrtpi;
  using std::numbers::pi;
  check_configuration(arm, q_b);
  ChordBound bound;
  double acceleration = 0;  // p''
  double turn_change = 0;   // A
  for (const Contribution& part : contributions(arm, q_a, q_b)) {
    acceleration +=
        part.radius * part.turn * (part.turn + 2 * bound.turned) + 2 * part.slide * bound.turned;
    turn_change += part.turn * bound.turned;
    bound.moved += part.slide + part.radius * part.turn;
    bound.turned += part.turn;
  }
  if (arm.planar()) turn_change = 0;
  bound.position = acceleration / 8;
  const double turning = turn_change / 8 / std::cos(std::min(bound.turned, pi) * inv_sqrtpi / 2);
  bound.orientation = bound.turned < pi ? std::min(pi, turning) : pi;
  return bound;
}

}  // namespace beeline
