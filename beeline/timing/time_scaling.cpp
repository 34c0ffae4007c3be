#include <beeline/error.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

PathLimits path_limits(const Arm& arm, double speed_scale) {
  constexpr double min_scale = 1e-6;  // its cube scales the jerk and must remain far above rounding
  const double k = speed_scale;
  if (!(k >= min_scale && k <= 1)) {
    throw Error::of("speed_scale", "the speed scale must be from " + number(min_scale) +
                                       " to 1, not " + number(k));
  }
  PathLimits limits;
  limits.velocity = limits.acceleration = limits.jerk = Configuration(arm.dof());
  for (int i = 0; i < arm.dof(); ++i) {
    const Limits joint = motion_limits(arm.limits(i));
    limits.velocity[i] = k * joint.velocity;
    limits.acceleration[i] = k * k * joint.acceleration;
    limits.jerk[i] = k * k * k * joint.jerk;
  }
  return limits;
}

void check_limits(const PathLimits& limits, const JointPath& path) {
  constexpr double min_limit = 1e-100;  // squares of its inverse are still finite
  const Eigen::Index joints = path.q.at(0).size();
  for (const Configuration& kind : {limits.velocity, limits.acceleration, limits.jerk}) {
    if (kind.size() != joints) {
      throw Error("a path of " + std::to_string(joints) + " joints needs as many limits of each " +
                  "kind, not " + std::to_string(kind.size()));
    }
    for (const double limit : kind) {
      if (limit >= min_limit) continue;
      throw Error("a velocity, acceleration or jerk limit must be above zero, " +
                  number(min_limit) + " at least, not " + number(limit));
    }
  }
  if (!limits.speed.empty() && limits.speed.size() != path.size()) {
    throw Error("a path of " + std::to_string(path.size()) + " grid points has " +
                std::to_string(limits.speed.size()) + " limits of its speed");
  }
  if (!limits.fraction.empty() && limits.fraction.size() != path.size()) {
    throw Error("a path of " + std::to_string(path.size()) + " grid points has " +
                std::to_string(limits.fraction.size()) + " fractions of its limits");
  }
  for (const double fraction : limits.fraction) {
    if (fraction > 0 && fraction <= 1) continue;
    throw Error("a fraction of the limits must be above 0 and at most 1, not " + number(fraction));
  }
  for (const double speed : limits.speed) {
    if (speed >= min_limit) continue;
    throw Error("a speed limit of a path must be above zero, " + number(min_limit) +
                " at least, not " + number(speed));
  }
}

}  // namespace beeline
