
#include <beeline/error.h>
#include <beeline/planning/nearby_path.h>

namespace beeline {
namespace {

constexpr double least_shift = 1e-3, max_shift = 0.26;  // metres
constexpr double least_turn = 1e-2, max_turn = 0.64;    // radians
constexpr int halvings = 5;

/// What is done to a path: a shift in the world's axes, and a turn in the tool's.
struct Change {
  Vector3 shift = Vector3::Zero();
  Rotation turn = Rotation::Identity();

  Pose operator()(Pose pose) const {
    pose.translation() += shift;
    pose.linear() = pose.linear() * turn;
    return pose;
  }
  Segment operator()(const Line& line) const { return Line{(*this)(line.from), (*this)(line.to)}; }
  Segment operator()(const ScrewLine& screw) const {
    return ScrewLine{(*this)(screw.from), (*this)(screw.to)};
  }
  Segment operator()(const Arc& arc) const {
    return Arc{(*this)(arc.from), (*this)(arc.to), arc.centre + shift, arc.turn};
  }
  Segment operator()(const SplineSegment& segment) const {
    return SplineSegment{(*this)(segment.centre), segment.terms};
  }
};

ToolPath changed(const ToolPath& path, bool first_stays, const Vector3& step, bool turns) {
  const Change change = turns ? Change{.turn = so3_exp(step)} : Change{.shift = step};
  ToolPath result = path;
  for (Segment& segment : result.segments) segment = std::visit(change, segment);
  if (first_stays) {
    Line& first = std::get<Line>(result.segments.front());
    first.from = pose_at(path, 0);
    result.spans.front() = span_of(first);
  }
  return result;
}

std::string described(const Vector3& step, int axis, bool turns) {
  const std::string sign = step[axis] < 0 ? "-" : "";
  const std::string letter(1, "xyz"[axis]);
  if (turns) return "with the tool turned by " + angle(step.norm()) + " about its " + sign + letter;
  return "moved by " + number(step.norm()) + " m along " + sign + letter;
}

}  // namespace

std::optional<NearbyPath> nearby_path(const Arm& arm, const std::optional<Configuration>& start,
                                      const ToolPath& path, const BranchOptions& options,
                                      bool turns) {
  const bool first_stays = start.has_value();
  if (first_stays && !all_lines(path))
    return {};  // the next segment would no longer go on smoothly
  BranchOptions exact = options;
  exact.reasons = BranchOptions::Reasons::none;
  exact.progress = {};
  exact.finest_grid = 64;
  BranchOptions quick = exact;  // for the search; what it finds is planned again
  quick.tolerance = {10 * options.tolerance.position, 10 * options.tolerance.orientation};
  const auto works = [&](const Vector3& step, const BranchOptions& planning) {
    const ToolPath other = changed(path, first_stays, step, turns);
    return plan_path(arm, start, other, planning).status == MotionStatus::reached;
  };
  for (double size = turns ? least_turn : least_shift; size <= (turns ? max_turn : max_shift);
       size *= 2) {
    for (int axis = 0; axis < 3; ++axis) {
      if (arm.planar() && turns != (axis == 2)) continue;
      for (const double sign : {1.0, -1.0}) {
        const Vector3 unit = sign * Vector3::Unit(axis);
        if (!works(size * unit, quick) || !works(size * unit, exact)) continue;
        double fails = size / 2, goes = size;
        for (int i = 0; i < halvings; ++i) {
          const double middle = (fails + goes) / 2;
          (works(middle * unit, quick) ? goes : fails) = middle;
        }
        const Vector3 step = works(goes * unit, exact) ? goes * unit : size * unit;
        NearbyPath found;
        (turns ? found.turned : found.moved) = step;
        found.path = changed(path, first_stays, step, turns);
        found.description = described(step, axis, turns);
        return found;
      }
    }
  }
  return {};
}

}  // namespace beeline
