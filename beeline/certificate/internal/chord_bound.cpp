#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/certificate/internal/orientation_gap.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

/// The contribution of one joint to the tool's motion; values that depend on t are at t = 1/2.
struct Contribution {
  Vector3 angular_velocity;  ///< W_j
  Vector3 velocity;          ///< m_j
  double rotation = 0;       ///< |W_j|, for all t
  double max_speed = 0;      ///< maximum of |m_j| over t
  double outer_speed = 0;    ///< sum_{k>=j} max_speed_k
};

std::vector<Contribution> contributions(const Arm& arm, const ConfigurationRef& q_a,
                                        const ConfigurationRef& q_b) {
  const std::vector<Pose> world_T_link = link_poses(arm, (q_a + q_b) / 2);
  const Vector3 tool = (world_T_link.back() * arm.tool()).translation();
  std::vector<Contribution> parts(arm.joints().size());
  double outer_speed = 0;
  for (std::size_t i = parts.size(); i-- > 0;) {
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    const double step = coupling.ratio * (q_b[coupling.coordinate] - q_a[coupling.coordinate]);
    const Twist velocity = joint_velocity(arm.joints()[i], world_T_link[i + 1], tool);
    Contribution& part = parts[i];
    part.angular_velocity = step * velocity.tail<3>();
    part.velocity = step * velocity.head<3>();
    part.rotation = part.angular_velocity.norm();
    part.max_speed = part.velocity.norm() + part.rotation * outer_speed / 2;
    part.outer_speed = outer_speed += part.max_speed;
  }
  return parts;
}

}  // namespace

ChordBound chord_bound(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b) {
  check_configuration(arm, q_a);
  check_configuration(arm, q_b);
  ChordBound bound;
  Vector3 before = Vector3::Zero();                           // B_j
  Vector3 acceleration = Vector3::Zero();                     // p''
  Vector3 angular_acceleration = Vector3::Zero();             // w'
  double before_rate = 0;                                     // |B_j'|
  double jerk = 0, angular_jerk = 0;                          // |p'''|, |w''|
  double max_acceleration = 0, max_angular_acceleration = 0;  // maxima of |p''| and |w'| over t
  for (const Contribution& part : contributions(arm, q_a, q_b)) {
    const double rotation_before = bound.rotation;  // >= |B_j|
    acceleration += (part.angular_velocity + 2 * before).cross(part.velocity);
    angular_acceleration += before.cross(part.angular_velocity);
    const double rate = rotation_before * part.rotation;
    const double velocity_rate =
        rotation_before * part.max_speed + part.rotation * part.outer_speed;
    jerk += (rate + 2 * before_rate) * part.max_speed +
            (part.rotation + 2 * rotation_before) * velocity_rate;
    angular_jerk += before_rate * part.rotation + rotation_before * rate;
    max_acceleration += (part.rotation + 2 * rotation_before) * part.max_speed;
    max_angular_acceleration += rotation_before * part.rotation;
    before += part.angular_velocity;
    before_rate += rate;
    bound.path_length += part.max_speed;
    bound.rotation += part.rotation;
  }
  bound.curvature_term = acceleration / 8;
  bound.remainder = jerk / 48;
  bound.position = std::min(bound.curvature_term.norm() + bound.remainder, max_acceleration / 8);
  bound.angular_acceleration = arm.rotates_about_z() ? Vector3::Zero() : angular_acceleration;
  bound.angular_remainder = arm.rotates_about_z() ? 0 : angular_jerk / 6;
  const double largest = std::min(bound.angular_acceleration.norm() + bound.angular_remainder,
                                  max_angular_acceleration);
  bound.orientation = orientation_gap(arm.rotates_about_z() ? 0 : largest, bound.rotation);
  return bound;
}

}  // namespace beeline::internal
