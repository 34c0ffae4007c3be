#include <algorithm>
#include <cmath>
#include <optional>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/null_space.h>
#include <beeline/planning/internal/track_segment.h>

namespace beeline {
namespace {

constexpr double rounding = 1e-11;  // metres and radians that a sample of an arm of 1 m may be off
constexpr double farthest_start = 1e-8;  // off the way, for an arm of 1 m
constexpr double first_step = 1.0 / 32;  // of a segment
constexpr double longest_step =
    1.0 / 4;                            // of a segment: its ends and some of its way are looked at
constexpr double shortest_step = 1e-7;  // of a segment: below it the arm has to jump
constexpr double largest_turn = 0.5;    // of one joint in one step, radians
constexpr double aside = 0.01;          // radians or metres: a guess off a singularity
constexpr double share = 0.8;           // of the tolerance that a step is made for

/// A step that is proved.
struct Step {
  Configuration q;
  Deviation bound;
};

/// Everything that one step needs.
struct SegmentTracker {
  const Arm& arm;
  const Segment& segment;
  const Task& task;
  const internal::Bounds& bounds;
  const TrackOptions& options;
  double exact = 0;  ///< at a sample
  Deviation ends;    ///< by which samples may be off
  double use = 0;    ///< of the tolerance, by the last step tried; 0: it had no configuration

  /// The configuration at the fraction `s`, next to the last; none when there is none or the motion
  /// to it is not proved to stay near the segment.
  std::optional<Step> step(const StepEnd& last, double s) {
    const Pose target = pose_at(segment, s);
    return proved(last, s, target,
                  options.guide ? options.guide(s) : predicted(arm, last.q, target, task, bounds));
  }

  /// The same from a singular q such as an arm stretched out, where the Jacobian shows no way: to
  /// the first side to which a joint can bend.
  std::optional<Step> step_aside(const StepEnd& last, double s) {
    const Pose target = pose_at(segment, s);
    for (int k = 0; k < arm.dof(); ++k) {
      for (const double side : {aside, -aside}) {
        Configuration guess = last.q;
        guess[k] += side;
        if (auto next = proved(last, s, target, guess)) return next;
      }
    }
    return {};
  }

  std::optional<Step> proved(const StepEnd& last, double s, const Pose& target,
                             const Configuration& guess) {
    use = 0;
    const internal::NumericalResult found = internal::levenberg_marquardt(
        arm, target, task, bounds, guess, {.tolerance = exact, .iterations = 30});
    if (!found.converged) return {};
    for (int k = 0; k < arm.dof(); ++k) {
      const bool turns = kind(arm.joint_of(k)) != JointKind::prismatic;
      if (turns && std::abs(found.q[k] - last.q[k]) > largest_turn) return {};
    }
    const Deviation bound = step_bound(arm, segment, task, last, {found.q, s, ends});
    use = std::max(bound.position / options.tolerance.position,
                   bound.orientation / options.tolerance.orientation);
    return use <= 1 ? std::optional(Step{found.q, bound}) : std::nullopt;
  }

  /// What the last step tried says of the length that the next may have: a bound falls with the
  /// square of it.
  double stretch() const {
    if (use == 0) return 0.5;
    const double wanted = std::sqrt(share / use);
    return use > 1 ? std::clamp(wanted, 0.1, 0.7) : std::clamp(wanted, 0.5, 3.0);
  }
};

/// The deviation that samples may have.
double exact_at_samples(const Arm& arm) {
  const double reach = arm.reach().radius;
  return rounding * (std::isfinite(reach) ? std::max(1.0, reach) : 1);
}

}  // namespace

TrackedSegment track_segment(const Arm& arm, const Segment& segment, const Task& task,
                             const internal::Bounds& bounds, const Configuration& start,
                             const TrackOptions& options) {
  check_task(arm, segment, task);
  const double exact = exact_at_samples(arm);
  // The nearest point of a line, which may be told by its position alone, can be that much off.
  const double turned = std::holds_alternative<Line>(segment) ? 1 + 1 / least_metres_per_radian : 1;
  SegmentTracker follower{arm, segment, task, bounds, options, exact, {exact, exact * turned}};
  TrackedSegment followed{{start}, {0}, {}};
  const Deviation off = deviation_from(segment, 0, forward_kinematics(arm, start), task);
  if (std::max(off.position, off.orientation) > farthest_start * follower.exact / rounding) {
    throw Error("the start is " + number(off.position) + " m and " + angle(off.orientation) +
                " away from where the way begins");
  }
  followed.deviation.sampled = off;
  double length = first_step;
  while (!followed.through() && length >= shortest_step &&
         followed.samples.size() < options.max_samples) {
    const double done = followed.fractions.back(), left = 1 - done;
    const double steps =
        std::ceil(left / length);  // equal ones to the end, none of rounding's size
    const double s = steps > 1 ? done + left / steps : 1;
    const Configuration& q = followed.samples.back();
    const StepEnd last{q, done, follower.ends};
    auto next = follower.step(last, s);
    const double stretch = follower.stretch();
    if (!next && followed.samples.size() == 1) next = follower.step_aside(last, s);
    length = std::min((s - done) * stretch, longest_step);
    if (!next) continue;
    const Pose middle = forward_kinematics(arm, (q + next->q) / 2);
    grow(followed.deviation.measured, deviation_from(segment, (done + s) / 2, middle, task));
    const Pose reached = forward_kinematics(arm, next->q);
    grow(followed.deviation.sampled, deviation_from(segment, s, reached, task));
    grow(followed.deviation.bound, next->bound);
    followed.samples.push_back(std::move(next->q));
    followed.fractions.push_back(s);
    if (options.progress && followed.samples.size() % 64 == 0) options.progress(s);
  }
  grow(followed.deviation.measured, followed.deviation.sampled);
  return followed;
}

}  // namespace beeline
