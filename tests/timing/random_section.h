#pragma once

#include <optional>

#include <beeline/timing/internal/sampled_section.h>

#include <tests/path/random_joint_path.h>
#include <tests/random_arm.h>
#include <tests/timing/every_profile.h>
#include <tests/trajectory/motion_by_columns.h>

/// Random paths of random arms with their time scalings, and what their samples must keep.
namespace beeline::testing {

constexpr double rates[] = {0, 50, 250, 1000};

/// An arm of 1 to 7 joints with limits of velocity; each has a known limit of acceleration in two
/// of three cases, and of jerk in half of these.
inline Arm limited_arm(Random& random) {
  const int count = random.integer(1, 7);
  std::vector<Joint> joints;
  for (int i = 0; i < count; ++i) {
    joints.push_back(random_joint(random, JointKind::revolute, "j" + std::to_string(i)));
    Limits& limits = joints.back().limits;
    limits.lower = -10;
    limits.upper = 10;
    limits.velocity = random.uniform(1, 3.2);
    if (random.integer(0, 2) > 0) limits.acceleration = random.uniform(2, 20);
    if (limits.acceleration < Limits::none && random.integer(0, 1) > 0) {
      limits.jerk = limits.acceleration * random.uniform(10, 500);
    }
  }
  return {"random", joints};
}

/// A path of an arm with its time scaling, and the options of its samples.
struct RandomSection {
  Arm arm;
  internal::TimedSection timed;
  internal::SectionOptions options;
};

inline RandomSection random_section(Random& random, Profile profile, Interpolation interpolation,
                                    double rate, double speed_scale) {
  Arm arm = limited_arm(random);
  const auto waypoints = random_waypoints(random, arm.dof(), random.integer(2, 6));
  const JointPath path = joint_spline(waypoints, chord_length(waypoints));
  internal::SectionOptions options{.timing = {.profile = profile,
                                              .interpolation = interpolation,
                                              .speed_scale = speed_scale,
                                              .rate = rate}};
  if (interpolation == Interpolation::linear) {
    for (int i = 1; i < 200; ++i) options.required.push_back(path.s.back() * i / 200);
  }
  auto timed = internal::timed_section(arm, path, options);
  return {std::move(arm), std::move(timed), std::move(options)};
}

/// The limit of an order that the options ask for: the known one, or an assumed one except for the
/// jerk of a profile that does not keep it; times a power of the speed scale.
inline double asked_limit(const Limits& known, const internal::SectionOptions& options, int order) {
  const double velocity = std::isfinite(known.velocity) ? known.velocity : assumed_velocity_limit;
  const double acceleration =
      std::isfinite(known.acceleration) ? known.acceleration : velocity / assumed_time_to_velocity;
  const double jerk = std::isfinite(known.jerk) || !options.keeps_jerk()
                          ? known.jerk
                          : acceleration / assumed_time_to_acceleration;
  const double limit = order == 1 ? velocity : order == 2 ? acceleration : jerk;
  return std::pow(options.timing.speed_scale, order) * limit;
}

/// The largest fraction of those limits that the interpolation bounds, at many points between
/// samples and on both sides of each; what rounding may add to it is taken off.
inline double asked_fraction(const Arm& arm, const Trajectory& motion,
                             const internal::SectionOptions& options, int order, int points = 12) {
  if (order > 1 + static_cast<int>(motion.interpolation())) return 0;
  double largest = 0;
  for (std::size_t k = 0; k + 1 < motion.size(); ++k) {
    const double rounding = rounding_of_derivative(motion, k, order);
    for (Eigen::Index i = 0; i < arm.dof(); ++i) {
      const double limit = asked_limit(arm.limits(i), options, order);
      if (!(limit < Limits::none)) continue;
      for (int part = 0; part <= points; ++part) {
        const double u = static_cast<double>(part) / points;
        const double value = std::abs(derivative_between(motion, k, i, u, order));
        largest = std::max(largest, (value - rounding) / limit);
      }
    }
  }
  return largest;
}

}  // namespace beeline::testing
