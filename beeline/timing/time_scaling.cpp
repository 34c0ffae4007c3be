#include <beeline/error.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

PathLimits path_limits(const Arm& arm, double share) {
  constexpr double least = 1e-6;  // its cube, of a jerk, is far above rounding
  if (!(share >= least && share <= 1)) {
    throw Error("the share of the speed limits must be from " + number(least) + " to 1, not " +
                number(share));
  }
  PathLimits limits;
  limits.velocity = limits.acceleration = limits.jerk = Configuration(arm.dof());
  for (int i = 0; i < arm.dof(); ++i) {
    const Limits& joint = arm.limits(i);
    limits.velocity[i] = share * held_velocity(joint);
    limits.acceleration[i] = share * share * joint.acceleration;
    limits.jerk[i] = share * share * share * joint.jerk;
  }
  return limits;
}

void check_limits(const PathLimits& limits, const JointPath& path) {
  const Eigen::Index joints = path.q.at(0).size();
  for (const Configuration& kind : {limits.velocity, limits.acceleration, limits.jerk}) {
    if (kind.size() == joints && (kind.array() > 0).all()) continue;
    throw Error("a path of " + std::to_string(joints) +
                " joints needs as many limits of each kind, all above zero");
  }
  if (!limits.speed.empty() && limits.speed.size() != path.size()) {
    throw Error("a path of " + std::to_string(path.size()) + " grid points has " +
                std::to_string(limits.speed.size()) + " limits of its speed");
  }
  for (const double speed : limits.speed) {
    if (!(speed > 0)) throw Error("a path's speed limit must be above zero, not " + number(speed));
  }
}

}  // namespace beeline
