#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/inverse/representative.h>
#include <beeline/inverse/search.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

/// SplitMix64 (Steele, Lea & Flood 2014): the same numbers on every machine, and free to start.
class Splitmix {
 public:
  explicit Splitmix(std::uint64_t seed) : state_(seed) {}

  /// Uniform in [0, 1).
  double next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// The box that random starts are drawn from: the bounds, closed where they are open.
Bounds start_box(const Arm& arm, const Pose& world_T_tool, const Bounds& bounds) {
  const Vector3 rest = forward_kinematics(arm, Configuration::Zero(arm.dof())).translation();
  const double away = (world_T_tool.translation() - rest).norm();
  const double length = std::max(away, unit_of_length(arm));
  Bounds box = bounds;
  for (int k = 0; k < arm.dof(); ++k) {
    const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
    const double far = slides ? length : std::numbers::pi;
    if (!std::isfinite(box.lower[k])) box.lower[k] = std::min(-far, box.upper[k] - 2 * far);
    if (!std::isfinite(box.upper[k])) box.upper[k] = std::max(far, box.lower[k] + 2 * far);
  }
  return box;
}

Configuration draw(const Bounds& box, Splitmix& random) {
  Configuration q(box.lower.size());
  for (int k = 0; k < q.size(); ++k) {
    const double share = random.next();
    q[k] = (1 - share) * box.lower[k] + share * box.upper[k];
  }
  return q;
}

double weight(const Arm& arm, const Deviation& error) {
  return std::hypot(error.position / unit_of_length(arm), error.orientation);
}

}  // namespace

Search search(const Arm& arm, const Pose& world_T_tool, const Task& task, const Bounds& bounds,
              const Configuration& start, const SearchOptions& options) {
  Search result;
  const Bounds box = start_box(arm, world_T_tool, bounds);
  Splitmix random(options.random_seed);
  for (int tries = 0; tries <= options.restarts; ++tries) {
    const Descent run =
        descend(arm, world_T_tool, task, bounds, tries == 0 ? start : draw(box, random),
                {.tolerance = options.tolerance, .iterations = options.iterations});
    result.iterations += run.iterations;
    result.restarts = tries;
    if (tries == 0 || weight(arm, run.error) < weight(arm, result.nearest.error)) {
      result.nearest = run;
    }
    if (!run.converged) continue;
    const bool known =
        std::any_of(result.solutions.begin(), result.solutions.end(),
                    [&](const Configuration& found) { return same_posture(arm, found, run.q); });
    if (!known) result.solutions.push_back(run.q);
    if (!options.all) break;
  }
  return result;
}

}  // namespace beeline
