#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/solve.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/along.h>
#include <beeline/motion/branch.h>
#include <beeline/motion/joint_faults.h>
#include <beeline/motion/timed_samples.h>

namespace beeline {
namespace {

constexpr double at_begin = 1e-9;  // metres and radians: a start this near is on the path
constexpr int coarse = 8;          // values of a joint to spare, for starts
constexpr double share = 0.9;      // of the tolerance that the plan may use

/// A way along the pieces, as far as it goes.
struct Way {
  std::vector<Followed> pieces;
  double done = 0;
  Margins margins;
};

Way follow_pieces(const Arm& arm, const Configuration& start, const ToolPath& path,
                  const Task& task, const LineOptions& options) {
  Way way;
  Configuration q = start;
  std::size_t left = static_cast<std::size_t>(options.most_samples);
  for (const Piece& piece : path.pieces) {
    way.pieces.push_back(
        follow(arm, piece, task, bounds_of(arm), q,
               {.tolerance = {share * options.tolerance, share * options.orientation_tolerance},
                .most_samples = left}));
    const Followed& piece_way = way.pieces.back();
    for (const Configuration& sample : piece_way.samples) {
      narrow(way.margins, arm, task, sample);
    }
    way.done += piece_way.fractions.back();
    if (!piece_way.through()) break;
    q = piece_way.samples.back();
    left -= std::min(left, piece_way.samples.size() - 1);
  }
  return way;
}

/// Why the way ends before the path does.
void explain(const Arm& arm, const ToolPath& path, const Task& task, const Way& way,
             const LineOptions& options, LineMotion& motion) {
  std::size_t samples = 1;
  for (const Followed& piece : way.pieces) samples += piece.samples.size() - 1;
  const std::size_t i = way.pieces.size() - 1;
  const Followed& last = way.pieces.back();
  const double s = last.fractions.back();
  const Vector3 p = pose_at(path.pieces[i], s).translation();
  motion.reason = "piece " + std::to_string(i + 1) + " of " + std::to_string(path.pieces.size()) +
                  " stops after " + number(100 * s) + " % of it, at x " + number(p.x()) + ", y " +
                  number(p.y()) + ", z " + number(p.z()) + " m: ";
  if (samples >= static_cast<std::size_t>(options.most_samples)) {
    motion.status = MotionStatus::not_converged;
    motion.reason += "more than " + std::to_string(options.most_samples) + " samples are needed";
    return;
  }
  const Pose ahead = pose_at(path.pieces[i], std::min(1.0, s + 1e-3));
  const InverseResult answer =
      inverse_kinematics(arm, ahead, {.seed = last.samples.back(), .task = task});
  const bool solved = answer.status == InverseStatus::solved;
  motion.status = solved ? MotionStatus::singular : status_of(answer.status);
  motion.reason += solved ? "the arm could go on only by jumping to another branch, or past a limit"
                          : answer.reason;
}

std::vector<Configuration> starts(const Arm& arm, const Pose& pose, const Task& task,
                                  LineMotion& motion) {
  const InverseResult answer = inverse_kinematics(
      arm, pose, {.task = task, .all = true, .every_turn = true, .grid = coarse});
  if (answer.solutions.empty()) {
    motion.status = status_of(answer.status);
    motion.reason = "the path's beginning: " + answer.reason;
  }
  return answer.solutions;
}

void check_start(const Arm& arm, const Configuration& start, const Pose& begin, const Task& task) {
  const auto outside = limit_violations(arm, start);
  if (!outside.empty()) throw Error("the motion cannot start: " + outside.front());
  const Deviation off = task_deviation(task, begin, forward_kinematics(arm, start));
  if (std::max(off.position, off.orientation) <= at_begin) return;
  throw Error("the motion cannot start: the tool is " + number(off.position) + " m and " +
              angle(off.orientation) + " away from the path's begin");
}

LineMotion failed(MotionStatus status, const std::string& reason) {
  LineMotion none;
  none.status = status;
  none.reason = reason;
  return none;
}

/// Where only what does not matter moves the arm stays, for a moment, so that each place of the
/// path has its sample.
void stand_still(Trajectory& trajectory, const std::vector<Configuration>& samples) {
  constexpr double moment = 1e-3;  // seconds
  for (std::size_t k = 1; k < samples.size(); ++k) {
    trajectory.times.push_back(trajectory.times.back() + moment);
    trajectory.positions.push_back(samples.front());
    trajectory.velocities.emplace_back(Configuration::Zero(samples.front().size()));
    trajectory.accelerations.emplace_back(Configuration::Zero(samples.front().size()));
  }
}

/// The samples from stop to stop get their times.
void time_pieces(const Arm& arm, const Route& route, const Way& way, const LineOptions& options,
                 LineMotion& motion, std::vector<double>& places) {
  const RetimeOptions retiming{.law = options.law, .tool_speed = options.tool_speed};
  motion.trajectory = at_rest(arm, way.pieces.front().samples.front());
  places = {0};
  std::vector<Configuration> stretch{motion.trajectory.positions.front()};
  for (std::size_t i = 0; i < way.pieces.size(); ++i) {
    const Followed& piece = way.pieces[i];
    for (std::size_t k = 1; k < piece.samples.size(); ++k) {
      stretch.push_back(piece.samples[k]);
      places.push_back(static_cast<double>(i) + piece.fractions[k]);
    }
    motion.arrivals.push_back(places.size() - 1);
    if (i + 1 < way.pieces.size() && !route.stops[i]) continue;
    const std::size_t before = motion.trajectory.size();
    motion.reason = append_timed(motion.trajectory, arm, stretch, retiming);
    if (motion.reason.empty() && motion.trajectory.size() == before) {
      stand_still(motion.trajectory, stretch);
    }
    if (motion.reason.empty() && motion.trajectory.size() != places.size()) {
      motion.reason = "the joints stand still on a part of the path, which has no smooth time law";
    }
    if (!motion.reason.empty()) {
      motion.status = MotionStatus::outside_limits;
      return;
    }
    stretch = {stretch.back()};
  }
  motion.status = MotionStatus::reached;
}

}  // namespace

Route route_of(const ToolPath& path, PathKind kind) {
  return {path, std::vector<bool>(path.pieces.size(), kind != PathKind::spline)};
}

Route route_of(const RoundedPath& rounded) {
  const auto& pieces = rounded.path.pieces;
  Route route{rounded.path, std::vector<bool>(pieces.size(), false)};
  std::size_t corner = 0;  // a line ends in a rounding, or at a corner that has none
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    const bool line = std::holds_alternative<Line>(pieces[i]);
    const bool next_line = std::holds_alternative<Line>(pieces[i + 1]);
    route.stops[i] = line && next_line && rounded.corners[corner].radius == 0;
    if (next_line) ++corner;
  }
  return route;
}

LineMotion move_along(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                      const LineOptions& options) {
  check_options(options);
  const ToolPath& path = route.path;
  if (path.pieces.empty() || route.stops.size() != path.pieces.size()) {
    throw Error("a route needs pieces, and for each whether the arm stops behind it");
  }
  const Task task = options.task.value_or(default_task(arm));
  for (const Piece& piece : path.pieces) check_matched(arm, piece, task);
  LineMotion motion;
  const Pose begin = pose_at(path.pieces.front(), 0);
  if (start) check_start(arm, *start, begin, task);
  const std::vector<Configuration> from =
      start ? std::vector{*start} : starts(arm, begin, task, motion);
  if (from.empty()) return motion;
  Way best;
  for (const Configuration& q : from) {
    Way way = follow_pieces(arm, q, path, task, options);
    const bool better = way.done > best.done ||
                        (way.done == best.done && way.margins.least() > best.margins.least());
    if (best.pieces.empty() || better) best = std::move(way);
  }
  if (best.done < static_cast<double>(path.pieces.size())) {
    explain(arm, path, task, best, options, motion);
    return motion;
  }
  std::vector<double> places;
  time_pieces(arm, route, best, options, motion, places);
  if (motion.status != MotionStatus::reached) return failed(motion.status, motion.reason);
  motion.straightness = closeness(arm, motion.trajectory.positions, places, path, task);
  motion.limits = limit_check(motion.trajectory, arm);
  motion.limit_margin = best.margins.limit;
  motion.dexterity = best.margins.dexterity;
  const auto fault = first_joint_fault(arm, motion.trajectory);
  if (fault && fault->kind == Fault::limits) {
    return failed(MotionStatus::outside_limits, fault->reason);
  }
  const std::string reason = not_proved(motion.straightness, options);
  return reason.empty() ? motion : failed(MotionStatus::not_converged, reason);
}

}  // namespace beeline
