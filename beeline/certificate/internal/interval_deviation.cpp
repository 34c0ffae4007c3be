#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <beeline/certificate/internal/interval_deviation.h>
#include <beeline/certificate/internal/interval_rounding.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/certificate/internal/segment_taylor_bound.h>
#include <beeline/certificate/internal/tool_error.h>
#include <beeline/kinematics/internal/tool_motion.h>
#include <beeline/kinematics/internal/tool_taylor_bound.h>
#include <beeline/path/internal/following.h>

namespace beeline::internal {
namespace {

constexpr int max_depth = 10;  // max number of bisections
// Fraction of the bound; with a smaller remainder the bound is not refined.
constexpr double small_remainder = 0.2;
constexpr double finest = 1e-13;     // metres and radians; smaller bounds are not refined
constexpr double small_error = 0.1;  // error of a projection, as a fraction of the goal

/// Hermite's remainder |e - H| <= |e^(6)| / 46080 from a bound on |e^(6)| / 6!.
constexpr double remainder_factor = 1.0 / 64;

class IntervalProof {
 public:
  IntervalProof(const Arm& arm, const Segment& segment, const Task& task,
                const Deviation& already_reported, const Deviation& goal)
      : arm_(arm),
        segment_(segment),
        task_(task),
        error_(arm, segment, task),
        interval_rounding_(arm, segment, task),
        already_reported_(already_reported),
        goal_(goal),
        along_goal_(small_error * error_.along_tolerance(goal)) {}

  IntervalDeviation run(const Interval& interval) {
    const End begin = end(interval, 0), last = end(interval, 1);
    refine(interval, begin, last, 0);
    grow(result_.bound, result_.measured);
    return result_;
  }

 private:
  struct End {
    ToolError error;
    double distance = 0;    ///< distance between the origins of tool and segment
    double angle = 0;       ///< angle between their orientations, free rows included
    double row_length = 0;  ///< length of a line in the task's position rows
  };

  End end(const Interval& interval, double u) {
    const Polynomial rate = interval.s.derivative();
    const double s = interval.s(u), ds = rate(u), dds = rate.derivative()(u);
    const PoseMotion tool = tool_motion(arm_, interval.coordinates, u);
    const PoseMotion path = motion_along(segment_, s, {ds, dds});
    grow(result_.measured, deviation_from(segment_, std::clamp(s, 0.0, 1.0), tool.pose, task_));
    const Twist difference = pose_difference(path.pose, tool.pose);
    End at{error_.at(tool, path), difference.head<3>().norm(), difference.tail<3>().norm()};
    if (const auto* line = std::get_if<Line>(&segment_)) {
      const Vector3 whole = line->to.translation() - line->from.translation();
      at.row_length = in_position_rows(task_, tool.pose, whole).norm();
    }
    return at;
  }

  void refine(const Interval& interval, const End& a, const End& b, int depth) {
    Extremes s = enclosure(interval.s);
    if (s.smallest < 0 || s.largest > 1) s = extremes(interval.s);
    const SegmentTaylorBound segment = segment_taylor_bound(segment_, s.smallest, s.largest);
    const TaylorBound s_bound = taylor_bound(interval.s);
    const ToolTaylorBound tool = tool_taylor_bound(arm_, interval.coordinates);
    const TaylorBound orientation = exponential(composed(segment.rotation, s_bound));
    TaylorBound distance = tool.position + composed(segment.position, s_bound);
    distance.c[0] = std::max(a.distance, b.distance) + distance.c[1] / 2;
    const double rotation = tool.orientation.c[1] + orientation.c[1];
    const ToolErrorRows::Range range{
        .angle = std::max(a.angle, b.angle) + rotation / 2,
        .s_min = s.smallest,
        .s_max = s.largest,
        .row_length = std::max(a.row_length, b.row_length) - segment.position.c[1] * rotation};
    const Deviation remainder =
        error_.remainder(distance, tool.orientation, orientation, remainder_factor);
    if (depth == 0) rounding_ = interval_rounding_.error_bounds(interval, segment);
    Deviation bound = error_.bound(
        a.error, b.error,
        {remainder.position + rounding_.position, remainder.orientation + rounding_.orientation},
        range);
    const double beyond = std::max({0.0, -s.smallest, s.largest - 1});
    bound.position += beyond * segment.position.c[1];
    bound.orientation =
        std::min(bound.orientation + beyond * segment.rotation.c[1], std::numbers::pi);
    const double along_error = remainder.position + rounding_.position;
    if (depth == max_depth ||
        (settled(&Deviation::position, bound, remainder) &&
         settled(&Deviation::orientation, bound, remainder) &&
         (along_error <= along_goal_ || remainder.position < rounding_.position))) {
      grow(result_.bound, bound);
      if (error_.projects()) {
        result_.projections.push_back(error_.projection(interval.s, a.error, b.error, along_error));
      }
      return;
    }
    const End middle = end(interval, 0.5);
    refine(part(interval, 0, 0.5), halved(a), halved(middle), depth + 1);
    refine(part(interval, 0.5, 1), halved(middle), halved(b), depth + 1);
  }

  bool settled(double Deviation::*part, const Deviation& bound, const Deviation& remainder) const {
    const double largest = result_.measured.*part;
    if (bound.*part <= std::max({finest, already_reported_.*part, largest})) return true;
    // A part's bound is at least the measured deviation and the rounding.
    const bool possible = largest + rounding_.*part <= goal_.*part;
    if (bound.*part > goal_.*part && possible) return false;
    return remainder.*part <= small_remainder * (bound.*part);
  }

  static End halved(End end) {
    end.error.rescale(0.5);
    return end;
  }

  const Arm& arm_;
  const Segment& segment_;
  const Task& task_;
  ToolErrorRows error_;
  IntervalRounding interval_rounding_;
  Deviation rounding_;  ///< of the whole interval, which holds for its parts
  Deviation already_reported_, goal_;
  double along_goal_;  ///< the largest error of a projection that is not refined, metres
  IntervalDeviation result_;
};

}  // namespace

Interval part(const Interval& interval, double from, double to) {
  Interval result{{}, interval.s.part(from, to)};
  for (const Polynomial& p : interval.coordinates) result.coordinates.push_back(p.part(from, to));
  return result;
}

IntervalDeviation interval_deviation(const Arm& arm, const Segment& segment, const Task& task,
                                     const Interval& interval, const Deviation& already_reported,
                                     const Deviation& goal) {
  return IntervalProof(arm, segment, task, already_reported, goal).run(interval);
}

}  // namespace beeline::internal
