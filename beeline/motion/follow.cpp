#include <algorithm>
#include <cmath>
#include <optional>

#include <beeline/motion/follow.h>
#include <beeline/motion/redundancy.h>
#include <beeline/motion/time_law.h>

namespace beeline {
namespace {

constexpr double rounding = 1e-11;  // metres and radians that a sample of an arm of 1 m may be off
constexpr double longest_step = 1.0 / 64;  // of a line's time: the time law needs that many samples
constexpr double shortest_step = 1e-7;     // of a line's time: below it the arm has to jump
constexpr double largest_turn = 0.1;       // of one joint in one step, radians
constexpr double aside = 0.01;             // radians or metres: a guess off a singularity

/// Everything that one step needs.
struct Follower {
  const Arm& arm;
  const Line& line;
  const Task& task;
  const Bounds& bounds;
  Deviation tolerance;  ///< between samples
  double exact = 0;     ///< at a sample

  /// The configuration at the fraction `u` of the line's time, next to q; none when there is none
  /// or the motion to it is not proved to stay near the line.
  std::optional<Configuration> step(const Configuration& q, double u) const {
    const Pose target = interpolate(line.from, line.to, rest_to_rest(u));
    return proved(q, target, predicted(arm, q, target, task, bounds));
  }

  /// The same from a singular q such as an arm stretched out, where the Jacobian shows no way: to
  /// the first side to which a joint can bend.
  std::optional<Configuration> step_aside(const Configuration& q, double u) const {
    const Pose target = interpolate(line.from, line.to, rest_to_rest(u));
    for (int k = 0; k < arm.dof(); ++k) {
      for (const double side : {aside, -aside}) {
        Configuration guess = q;
        guess[k] += side;
        if (const auto next = proved(q, target, guess)) return next;
      }
    }
    return {};
  }

  std::optional<Configuration> proved(const Configuration& q, const Pose& target,
                                      const Configuration& guess) const {
    const Descent found =
        descend(arm, target, task, bounds, guess, {.tolerance = exact, .iterations = 30});
    if (!found.converged) return {};
    for (int k = 0; k < arm.dof(); ++k) {
      const bool turns = kind(arm.joint_of(k)) != JointKind::prismatic;
      if (turns && std::abs(found.q[k] - q[k]) > largest_turn) return {};
    }
    // The nearest point of the line, which may be told by its position alone, can be that much off.
    const Deviation ends{exact, exact * (1 + 1 / way_of_a_radian)};
    const Deviation bound = step_bound(arm, line, task, q, found.q, ends, ends);
    const bool near =
        bound.position <= tolerance.position && bound.orientation <= tolerance.orientation;
    return near ? std::optional(found.q) : std::nullopt;
  }
};

}  // namespace

Followed follow(const Arm& arm, const Line& line, const Task& task, const Bounds& bounds,
                const Configuration& start, const FollowOptions& options) {
  const double reach = arm.reach().radius;
  const double size = std::isfinite(reach) ? std::max(1.0, reach) : 1;
  const Follower follower{arm, line, task, bounds, options.tolerance, rounding * size};
  Followed way{{start}, {0}};
  double length = longest_step;
  while (!way.through() && length >= shortest_step && way.samples.size() < options.most_samples) {
    // Equal steps to the end: a last one of rounding's size would spoil the time law's differences.
    const double done = way.fractions.back(), left = 1 - done;
    const double steps = std::ceil(left / length);
    const double u = steps > 1 ? done + left / steps : 1;
    auto next = follower.step(way.samples.back(), u);
    if (!next && way.samples.size() == 1) next = follower.step_aside(start, u);
    if (next) {
      way.samples.push_back(*next);
      way.fractions.push_back(u);
      length = std::min(1.5 * length, longest_step);
      if (options.progress && way.samples.size() % 64 == 0) options.progress(u);
    } else {
      length = std::min(length, left) / 2;
    }
  }
  return way;
}

}  // namespace beeline
