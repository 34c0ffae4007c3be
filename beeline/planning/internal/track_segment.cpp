#include <algorithm>
#include <cmath>
#include <optional>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/knot_sequence.h>
#include <beeline/planning/internal/null_space.h>
#include <beeline/planning/internal/track_segment.h>

namespace beeline::internal {
namespace {

// Max deviation of a sample for an arm of 1 m reach, metres and radians: about a hundred times the
// rounding of forward kinematics, so that every regular pose can be solved to it.
constexpr double sample_tolerance = 1e-11;

// Lengths of a step as fractions of the segment. The first is a guess, corrected after one step; in
// a short segment it is longer, up to first_span of the arm's reach.
// The longest ensures samples inside the segment, unless the segment is shorter than longest_span
// of the arm's size, where rounding errors would dominate. If the shortest fails, the arm would
// have to
// jump: the bound is proportional to the square of the step, so a continuous motion allows 1e-5 and
// more. In a segment longer than the arm's size the shortest step is this fraction of the size. At
// its beginning the arm may be stretched: the joints move as the square root of the step there, the
// bound is proportional to the step, and only shorter ones keep the smallest tolerances.
constexpr double first_step = 1.0 / 32, first_span = 0.01;
constexpr double longest_step = 1.0 / 4, longest_span = 0.001;
constexpr double shortest_step = 1e-7, shortest_step_of_beginning = 1e-9;
constexpr double beginning = 1e-5;  // of the segment

// A first step of this length does not follow the guide if it cannot.
constexpr double last_guided_step = 1e-4;

constexpr double max_joint_rotation = 0.5;  // of one joint in one step, radians
constexpr double side_step = 0.01;          // radians or metres, from a singular start
// The step length aims at this fraction of the tolerance. Closer to 1, more steps fail and are
// repeated.
constexpr double aimed_fraction = 0.8;

/// A step that is proved.
struct Step {
  Configuration q;
  Deviation bound;
};

struct SegmentTracker {
  const Arm& arm;
  const Segment& segment;
  const Task& task;
  const Bounds& bounds;
  const TrackOptions& options;
  double exact = 0;  ///< tolerance of a sample
  Deviation ends;    ///< largest deviation of a sample
  double usage = 0;  ///< bound / tolerance of the last step tried; 0 where it had no configuration

  /// Returns the guide's configuration at the fraction `s`; empty if it has none.
  Configuration guided(double s) const {
    return options.guide ? options.guide(s) : Configuration();
  }

  /// Returns the configuration at the fraction `s` that continues the last one; nothing if there is
  /// none, or if the deviation of the step is not proved to be within tolerance.
  std::optional<Step> step(const StepEnd& last, double s) {
    const Pose target = pose_at(segment, s);
    Configuration guess = guided(s);
    if (guess.size() == 0) guess = predict_configuration(arm, last.q, target, task, bounds);
    return proved(last, s, target, guess);
  }

  /// Does the same from a singular configuration such as a stretched arm, at which the Jacobian
  /// gives no direction: tries each joint to both sides.
  std::optional<Step> step_aside(const StepEnd& last, double s) {
    const Pose target = pose_at(segment, s);
    for (int k = 0; k < arm.dof(); ++k) {
      for (const double side : {side_step, -side_step}) {
        if (options.budget.ended()) return {};
        Configuration guess = last.q;
        guess[k] += side;
        if (auto next = proved(last, s, target, guess)) return next;
      }
    }
    return {};
  }

  std::optional<Step> proved(const StepEnd& last, double s, const Pose& target,
                             const Configuration& guess) {
    usage = 0;
    const NumericalResult found =
        levenberg_marquardt(arm, target, task, bounds, guess,
                            {.tolerance = exact, .max_iterations = 30, .budget = options.budget});
    if (!found.converged) return {};
    for (int k = 0; k < arm.dof(); ++k) {
      const bool rotates = kind(arm.joint_of(k)) != JointKind::prismatic;
      if (rotates && std::abs(found.q[k] - last.q[k]) > max_joint_rotation) return {};
    }
    const Deviation bound = step_bound(arm, segment, task, last, {found.q, s, ends});
    usage = std::max(bound.position / options.tolerance.position,
                     bound.orientation / options.tolerance.orientation);
    return usage <= 1 ? std::optional(Step{found.q, bound}) : std::nullopt;
  }

  /// Returns the ratio of the next step's length to the last one's: the bound is proportional to
  /// the square of the length.
  double length_factor() const {
    if (usage == 0) return 0.5;
    const double wanted = std::sqrt(aimed_fraction / usage);
    return usage > 1 ? std::clamp(wanted, 0.1, 0.7) : std::clamp(wanted, 0.5, 3.0);
  }
};

double tolerance_of_samples(const Arm& arm) {
  const double reach = arm.reach().radius;
  return sample_tolerance * (std::isfinite(reach) ? std::max(1.0, reach) : 1);
}

/// Throws Error unless the tool is at the segment's pose at options.begin, or at another pose of
/// it. On a line the nearest pose may be a small distance ahead and there, where the line is short
/// for its rotation, have another orientation.
void check_start(const SegmentTracker& tracker, const Pose& tool, const Deviation& deviation) {
  const double allowed = start_tolerance(tracker.arm);
  const Deviation largest{allowed, allowed};
  const Pose begin = pose_at(tracker.segment, tracker.options.begin);
  if (within(deviation, largest)) return;
  if (within(task_deviation(tracker.task, begin, tool), largest)) return;
  throw Error("at the start the tool is " + deviation_text(deviation) +
              " from the path's beginning; at most " + number(allowed) + " m and rad are allowed");
}

}  // namespace

double start_tolerance(const Arm& arm) {
  constexpr double of_unit_arm = 1e-8;
  return of_unit_arm * tolerance_of_samples(arm) / sample_tolerance;
}

TrackedSegment track_segment(const Arm& arm, const Segment& segment, const Task& task,
                             const Bounds& bounds, const Configuration& start,
                             const TrackOptions& options) {
  check_task(arm, segment, task);
  const double exact = tolerance_of_samples(arm);
  // The nearest point of a line may be determined by position only, to `exact`. Its orientation is
  // then uncertain by the rotation of the line over that length.
  const double rotated = std::holds_alternative<Line>(segment) ? 1 + 1 / min_metres_per_radian : 1;
  SegmentTracker tracker{arm, segment, task, bounds, options, exact, {exact, exact * rotated}};
  TrackedSegment tracked{{start}, {options.begin}, {}};
  const Pose tool = forward_kinematics(arm, start);
  const Deviation at_start = deviation_from(segment, options.begin, tool, task);
  check_start(tracker, tool, at_start);
  PathDeviation& deviation = tracked.deviation;
  deviation.sampled = at_start;
  deviation.bound = {};
  const double size = 1 / weighted_length(arm, segment);
  const auto shortest = [&](double s) {
    const bool begins = s - options.begin < beginning;
    return (begins ? shortest_step_of_beginning : shortest_step) * std::min(1.0, size);
  };
  const double longest = std::clamp(longest_span * size, longest_step, 1.0);
  double length = std::clamp(first_span * size, first_step, longest);
  while (!tracked.complete() && length >= shortest(tracked.fractions.back()) &&
         tracked.samples.size() < options.max_samples && !options.budget.ended()) {
    const double s_a = tracked.fractions.back(), left = 1 - s_a;
    // Equal steps to the end, so that no step is as short as rounding.
    const double steps = std::ceil(left / length);
    const double s = steps > 1 ? s_a + left / steps : 1;
    const Configuration& q = tracked.samples.back();
    const StepEnd last{q, s_a, tracker.ends};
    auto next = tracker.step(last, s);
    const double factor = tracker.length_factor();
    const bool guided = s - s_a > last_guided_step && tracker.guided(s).size() > 0;
    if (!next && !guided && tracked.samples.size() == 1) next = tracker.step_aside(last, s);
    length = std::min((s - s_a) * factor, longest);
    if (!next) continue;
    const Pose middle = forward_kinematics(arm, (q + next->q) / 2);
    grow(deviation.measured, deviation_from(segment, (s_a + s) / 2, middle, task));
    const Pose end = forward_kinematics(arm, next->q);
    grow(deviation.sampled, deviation_from(segment, s, end, task));
    grow(deviation.bound, next->bound);
    tracked.samples.push_back(std::move(next->q));
    tracked.fractions.push_back(s);
    if (options.progress && tracked.samples.size() % 64 == 0) options.progress(s);
  }
  grow(deviation.measured, deviation.sampled);
  return tracked;
}

}  // namespace beeline::internal
