#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/planning/nearby_path.h>

namespace beeline {
namespace {

// Sizes of the changes that are tried; each is twice the one before.
constexpr double min_translation = 1e-3, max_translation = 0.26;  // metres
constexpr double min_rotation = 1e-2, max_rotation = 0.64;        // radians
constexpr int bisections = 5;  // to 1/64 of the size that was found

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

std::string described(const Vector3& step, int axis, bool rotate) {
  const std::string letter = (step[axis] < 0 ? "-" : "") + std::string(1, "xyz"[axis]);
  if (rotate) return "with the tool turned by " + angle(step.norm()) + " about its " + letter;
  return "moved by " + number(step.norm()) + " m along " + letter;
}

/// plan_path() along changed paths.
struct Trial {
  const Arm& arm;
  const std::optional<Configuration>& start;
  const ToolPath& path;
  bool rotate;
  BranchOptions exact;
  BranchOptions coarse;  ///< for the search; its result is planned again

  bool works(const Vector3& step, const BranchOptions& options) const {
    const ToolPath other = changed(path, start.has_value(), step, rotate);
    return static_cast<bool>(plan_path(arm, start, other, options));
  }

  /// Returns the smallest step along `unit` with which planning succeeds, given that it succeeds
  /// with `size` and fails with half of it.
  Vector3 refined(const Vector3& unit, double size) const {
    double fails = size / 2, succeeds = size;
    for (int i = 0; i < bisections; ++i) {
      const double middle = (fails + succeeds) / 2;
      (works(middle * unit, coarse) ? succeeds : fails) = middle;
    }
    return works(succeeds * unit, exact) ? succeeds * unit : size * unit;
  }
};

}  // namespace

std::optional<NearbyPath> nearby_path(const Arm& arm, const std::optional<Configuration>& start,
                                      const ToolPath& path, const BranchOptions& options,
                                      bool rotate) {
  internal::check_task(arm, path, options.task);
  // Other segments would no longer join the first one smoothly.
  if (start && !internal::all_lines(path)) return {};
  Trial trial{arm, start, path, rotate, options, options};
  trial.exact.reasons = BranchOptions::Reasons::none;
  internal::BudgetMeter budget(options.budget);
  trial.exact.budget = budget.part();
  trial.exact.max_grid = 64;
  trial.coarse = trial.exact;
  trial.coarse.tolerance = {10 * options.tolerance.position, 10 * options.tolerance.orientation};
  const double largest = rotate ? max_rotation : max_translation;
  const int sizes =
      1 + static_cast<int>(std::log2(largest / (rotate ? min_rotation : min_translation)));
  const int directions = arm.planar() ? (rotate ? 2 : 4) : 6;
  int tried = 0;
  for (double size = rotate ? min_rotation : min_translation; size <= largest; size *= 2) {
    for (int axis = 0; axis < 3; ++axis) {
      if (arm.planar() && rotate != (axis == 2)) continue;
      for (const double sign : {1.0, -1.0}) {
        if (budget.ended()) return {};
        budget.report(static_cast<double>(tried++) / (sizes * directions));
        const Vector3 unit = sign * Vector3::Unit(axis);
        if (!trial.works(size * unit, trial.coarse) || !trial.works(size * unit, trial.exact)) {
          continue;
        }
        const Vector3 step = trial.refined(unit, size);
        NearbyPath found;
        (rotate ? found.turned : found.moved) = step;
        found.path = changed(path, start.has_value(), step, rotate);
        found.description = described(step, axis, rotate);
        return found;
      }
    }
  }
  return {};
}

}  // namespace beeline
