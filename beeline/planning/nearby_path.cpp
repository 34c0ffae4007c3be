#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/planned_motion.h>
#include <beeline/planning/internal/self_motion_graph.h>
#include <beeline/planning/move_along.h>

namespace beeline {
namespace {

// Sizes of the changes that are tried; each is four times the one before.
constexpr double min_translation = 4e-3, max_translation = 0.256;  // metres
constexpr double min_rotation = 1e-2, max_rotation = 0.64;         // radians
constexpr double ratio = 4;
constexpr int bisections = 5;  // to 3/128 of the size that was found

/// A translation in world axes and a rotation in tool axes, applied to poses and segments.
struct Change {
  Vector3 translation = Vector3::Zero();
  Rotation rotation = Rotation::Identity();

  Pose operator()(Pose pose) const {
    pose.translation() += translation;
    pose.linear() = pose.linear() * rotation;
    return pose;
  }
  Segment operator()(const Line& line) const { return Line{(*this)(line.from), (*this)(line.to)}; }
  Segment operator()(const ScrewLine& screw) const {
    return ScrewLine{(*this)(screw.from), (*this)(screw.to)};
  }
  Segment operator()(const Arc& arc) const {
    return Arc{(*this)(arc.from), (*this)(arc.to), arc.centre + translation, arc.rotation};
  }
  Segment operator()(const SplineSegment& segment) const {
    return SplineSegment{(*this)(segment.centre), segment.terms};
  }
};

ToolPath changed(const ToolPath& path, bool keep_first_pose, const Vector3& step, bool rotate) {
  const Change change = rotate ? Change{.rotation = so3_exp(step)} : Change{.translation = step};
  ToolPath result = path;
  for (Segment& segment : result.segments) segment = std::visit(change, segment);
  if (keep_first_pose) {
    Line& first = std::get<Line>(result.segments.front());
    first.from = pose_at(path, 0);
    result.spans.front() = span_of(first);
  }
  return result;
}

/// "-z", or "(0.707107, 0, -0.707107)".
std::string direction_text(const Vector3& unit) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(unit[axis]) == 1) return (unit[axis] < 0 ? "-" : "") + std::string(1, "xyz"[axis]);
  }
  return "(" + number(unit.x()) + ", " + number(unit.y()) + ", " + number(unit.z()) + ")";
}

std::string described(const Vector3& unit, double size, bool rotate, bool keep_first_pose) {
  const std::string direction = direction_text(unit);
  const std::string start = keep_first_pose ? "; the start stays" : "";
  if (!rotate) {
    return "with every waypoint moved by " + number(size) + " m along " + direction + start;
  }
  const bool axis = unit.cwiseAbs().maxCoeff() == 1;
  return "with the tool turned at every waypoint by " + angle(size) + " about its " +
         (axis ? "" : "axis ") + direction + start;
}

/// Returns the axes of the world or the tool in both directions, and the directions half-way
/// between two and three of them. For a planar arm, returns only directions in which it can move.
std::vector<Vector3> directions(bool planar, bool rotate) {
  std::vector<Vector3> units;
  for (int axes = 1; axes <= 3; ++axes) {
    for (int i = 0; i < 27; ++i) {
      const int y = i / 3 % 3, z = i / 9;
      const Vector3 v(i % 3 - 1, y - 1, z - 1);
      if (v.squaredNorm() != axes) continue;
      if (planar && (rotate ? v.head<2>().squaredNorm() : std::abs(v.z())) > 0) continue;
      units.push_back(axes == 1 ? v : Vector3(v.normalized()));
    }
  }
  return units;
}

/// plan_path() along changed paths.
struct Trial {
  const Arm& arm;
  const std::optional<Configuration>& start;
  const ToolPath& path;
  bool rotate;
  BranchOptions exact;
  BranchOptions coarse;  ///< for the search; its result is planned again
  InverseOptions one;    ///< for one solution within the limits
  Configuration middle;  ///< its seed

  ToolPath at(const Vector3& step) const { return changed(path, start.has_value(), step, rotate); }

  bool works(const Vector3& step) const { return is_free(plan_path(arm, start, at(step), exact)); }

  double smallest() const { return rotate ? min_rotation : min_translation; }

  /// Whether inverse kinematics finds a configuration for the end of each segment.
  bool ends_are_reachable(const Vector3& step) const {
    const ToolPath changed_path = at(step);
    Eigen::MatrixXd solution(arm.dof(), 1);
    for (std::size_t i = changed_path.segments.size(); i > 0; --i) {
      const Pose end = pose_at(changed_path.segments[i - 1], 1);
      if (inverse_kinematics(arm, end, middle, solution, one) == 0) return false;
    }
    return true;
  }

  /// A quick test, on a coarse graph or with a coarse tolerance.
  bool may_work(const Vector3& step) const {
    if (!ends_are_reachable(step)) return false;
    const Task rows = internal::independent_rows(arm, exact.task);
    if (rows.size() > 0 && arm.dof() == rows.size() + 1) {
      return internal::has_self_motion_path(
          arm, at(step),
          {.task = rows, .start = start, .spacing = 0.12, .step = 0.3, .budget = exact.budget});
    }
    return is_free(plan_path(arm, start, at(step), coarse));
  }

  /// Whether planning succeeds with a step; the quick test first.
  bool tried(const Vector3& step) const { return may_work(step) && works(step); }

  /// Whether a branch is complete and not blocked, with a reserve for what is between its samples.
  static bool is_free(const Branch& branch) {
    constexpr double reserve = 2e-4;  // metres
    return branch && branch.spare_clearance >= reserve;
  }

  /// Reduces the size of a step along `unit`, with which planning succeeds, by bisection down to
  /// `fails`.
  double refined(const Vector3& unit, double fails, double size) const {
    double succeeds = size;
    for (int i = 0; i < bisections; ++i) {
      const double middle = (fails + succeeds) / 2;
      const bool works_there =
          exact.spare_clearance ? tried(middle * unit) : may_work(middle * unit);
      (works_there ? succeeds : fails) = middle;
    }
    return works(succeeds * unit) ? succeeds : size;
  }
};

}  // namespace

std::optional<NearbyPath> nearby_path(const Arm& arm, const std::optional<Configuration>& start,
                                      const ToolPath& path, const BranchOptions& options,
                                      bool rotate) {
  internal::check_task(arm, path, options.task);
  const bool line_first = std::holds_alternative<Line>(path.segments.front());
  const bool ends_at_corner = internal::all_lines(path) || corner_at(path, 1);
  if (start && !(line_first && ends_at_corner)) return {};
  Budget all = options.budget;
  constexpr std::int64_t most = internal::max_nearby_path_work;
  if (!all.max_work || *all.max_work > most) all.max_work = most;
  internal::BudgetMeter budget(all);
  InverseOptions one{.task = options.task,
                     .redundancy = Redundancy::any,
                     .grid = 16,
                     .max_restarts = 32,
                     .budget = budget.part()};
  const auto& spare = options.spare_clearance;
  if (spare) {
    one.blocked_by = [&spare](const ConfigurationRef& q) {
      return spare(q) < 0 ? Reason{ReasonCode::bodies_too_close} : Reason{};
    };
  }
  Trial trial{arm, start, path, rotate, options, options, one, middle_configuration(arm)};
  trial.exact.reasons = BranchOptions::Reasons::none;
  trial.exact.budget = budget.part();
  trial.exact.max_grid = 16;
  trial.coarse = trial.exact;
  trial.coarse.tolerance = {10 * options.tolerance.position, 10 * options.tolerance.orientation};
  const double largest = rotate ? max_rotation : max_translation;
  const int sizes =
      1 + static_cast<int>(std::log(largest / trial.smallest()) / std::log(ratio) + 1e-6);
  const std::vector<Vector3> units = directions(arm.planar(), rotate);
  const double trials = static_cast<double>(units.size()) * sizes;
  // Each direction that also succeeds with the smallest size so far reduces it further.
  constexpr double shorter = 0.9;
  double size = trial.smallest(), fails = 0;
  std::optional<Vector3> best;
  for (int n = 0; n < sizes; ++n) {
    for (std::size_t i = 0; i < units.size() && !budget.ended(); ++i) {
      budget.report((n * static_cast<double>(units.size()) + static_cast<double>(i)) / trials);
      const double wanted = best ? shorter * size : size;
      if (!trial.tried(wanted * units[i])) continue;
      best = units[i];
      size = trial.refined(units[i], fails, wanted);
    }
    if (best) break;
    fails = size;
    size *= ratio;
  }
  if (!best) return {};
  NearbyPath found;
  (rotate ? found.rotation : found.translation) = size * *best;
  found.path = trial.at(size * *best);
  found.description = described(*best, size, rotate, start.has_value());
  return found;
}

}  // namespace beeline
