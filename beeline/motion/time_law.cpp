#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/motion/time_law.h>

namespace beeline {
namespace {

constexpr double shortest_duration = 1e-3;  // seconds: times increase even where nothing moves

/// Derivatives by differences over the fraction of time u, to be divided by the duration.
struct Derivatives {
  std::vector<Configuration> between;       ///< dq/du between samples k and k + 1
  std::vector<Configuration> velocity;      ///< dq/du at sample k; zero at both ends
  std::vector<Configuration> acceleration;  ///< d2q/du2 at sample k; zero at both ends
  std::vector<Configuration> jerk;          ///< d3q/du3 between samples
};

Derivatives differentiate(std::span<const Configuration> samples, std::span<const double> u) {
  const std::size_t steps = samples.size() - 1;
  Derivatives d;
  const Configuration rest = Configuration::Zero(samples[0].size());
  for (std::size_t k = 0; k < steps; ++k) {
    d.between.push_back((samples[k + 1] - samples[k]) / (u[k + 1] - u[k]));
  }
  d.velocity.assign(steps + 1, rest);
  d.acceleration.assign(steps + 1, rest);
  for (std::size_t k = 1; k < steps; ++k) {
    const double before = u[k] - u[k - 1], after = u[k + 1] - u[k];
    d.velocity[k] = (after * d.between[k - 1] + before * d.between[k]) / (before + after);
    d.acceleration[k] = 2 * (d.between[k] - d.between[k - 1]) / (before + after);
  }
  for (std::size_t k = 0; k < steps; ++k) {
    d.jerk.push_back((d.acceleration[k + 1] - d.acceleration[k]) / (u[k + 1] - u[k]));
  }
  return d;
}

double largest_ratio(const std::vector<Configuration>& derivative, const Configuration& limit) {
  double ratio = 0;
  for (const Configuration& value : derivative) {
    ratio = std::max(ratio, value.cwiseQuotient(limit).lpNorm<Eigen::Infinity>());
  }
  return ratio;
}

/// One kind of limit of every coordinate.
Configuration limits_of(const Arm& arm, double Limits::*kind, double when_unknown) {
  Configuration limits(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const double limit = arm.limits()[static_cast<std::size_t>(k)].*kind;
    limits[k] = std::isfinite(limit) ? limit : when_unknown;
  }
  return limits;
}

void check_motion(const Arm& arm, std::span<const Configuration> samples,
                  std::span<const double> fractions) {
  if (samples.size() < 2 || samples.size() != fractions.size()) {
    throw Error("a timed motion needs two samples or more, and a fraction of time for each");
  }
  for (const Configuration& q : samples) check_configuration(arm, q);
  for (std::size_t k = 1; k < fractions.size(); ++k) {
    if (fractions[k] > fractions[k - 1]) continue;
    throw Error("the fractions of time must increase; number " + std::to_string(k + 1) + " is " +
                number(fractions[k]));
  }
  if (fractions.front() != 0 || fractions.back() != 1) {
    throw Error("the fractions of time must go from 0 to 1, not from " + number(fractions.front()) +
                " to " + number(fractions.back()));
  }
}

}  // namespace

double rest_to_rest(double u) { return u * u * u * (10 + u * (-15 + 6 * u)); }

void append_timed(Trajectory& trajectory, const Arm& arm, std::span<const Configuration> samples,
                  std::span<const double> fractions, double shortest) {
  if (trajectory.size() == 0) throw Error("a timed motion needs a trajectory to continue");
  check_motion(arm, samples, fractions);
  if (!(shortest >= 0) || !std::isfinite(shortest)) {
    throw Error("the shortest time of a motion must be zero or more, not " + number(shortest) +
                " s");
  }
  const Derivatives d = differentiate(samples, fractions);
  const double duration = std::max(
      {shortest, largest_ratio(d.between, limits_of(arm, &Limits::velocity, velocity_when_unknown)),
       std::sqrt(
           largest_ratio(d.acceleration, limits_of(arm, &Limits::acceleration, Limits::none))),
       std::cbrt(largest_ratio(d.jerk, limits_of(arm, &Limits::jerk, Limits::none))),
       shortest_duration});

  const double start = trajectory.times.back();
  for (std::size_t k = 1; k < samples.size(); ++k) {
    trajectory.times.push_back(start + duration * fractions[k]);
    trajectory.positions.push_back(samples[k]);
    trajectory.velocities.push_back(d.velocity[k] / duration);
    trajectory.accelerations.push_back(d.acceleration[k] / (duration * duration));
  }
}

}  // namespace beeline
