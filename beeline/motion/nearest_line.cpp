#include <array>

#include <beeline/error.h>
#include <beeline/motion/nearest_line.h>

namespace beeline {
namespace {

constexpr double least_shift = 1e-3, most_shift = 0.26;  // metres
constexpr double least_turn = 1e-2, most_turn = 0.64;    // radians
constexpr int halvings = 5;

std::vector<Pose> changed(std::span<const Pose> poses, bool first_stays, const Vector3& step,
                          bool turns) {
  std::vector<Pose> result(poses.begin(), poses.end());
  for (std::size_t i = first_stays ? 1 : 0; i < result.size(); ++i) {
    if (turns) {
      result[i].linear() = result[i].linear() * so3_exp(step);
    } else {
      result[i].translation() += step;
    }
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

std::optional<NearbyLines> nearest_lines(const Arm& arm, const std::optional<Configuration>& start,
                                         std::span<const Pose> poses, const BranchOptions& options,
                                         bool turns) {
  BranchOptions quick = options;
  quick.tolerance = {10 * options.tolerance.position, 10 * options.tolerance.orientation};
  quick.reasons = BranchOptions::Reasons::none;
  quick.progress = {};
  const auto works = [&](const Vector3& step) {
    return plan_lines(arm, start, changed(poses, start.has_value(), step, turns), quick).status ==
           MotionStatus::reached;
  };
  for (double size = turns ? least_turn : least_shift; size <= (turns ? most_turn : most_shift);
       size *= 2) {
    for (int axis = 0; axis < 3; ++axis) {
      if (arm.planar() && turns != (axis == 2)) continue;
      for (const double sign : {1.0, -1.0}) {
        const Vector3 unit = sign * Vector3::Unit(axis);
        if (!works(size * unit)) continue;
        double fails = size / 2, goes = size;
        for (int i = 0; i < halvings; ++i) {
          const double middle = (fails + goes) / 2;
          (works(middle * unit) ? goes : fails) = middle;
        }
        const Vector3 step = goes * unit;
        NearbyLines found;
        (turns ? found.turned : found.moved) = step;
        found.poses = changed(poses, start.has_value(), step, turns);
        found.description = described(step, axis, turns);
        return found;
      }
    }
  }
  return {};
}

}  // namespace beeline
