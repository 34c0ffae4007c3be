#include <algorithm>

#include <beeline/inverse/numerical/bounds.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/joint.h>
#include <beeline/planning/internal/singular_joint.h>

namespace beeline::internal {

std::optional<int> singular_joint(const Arm& arm, const Task& task, const Configuration& q) {
  constexpr double change = 0.1;  // radians, or fraction of the arm's size
  constexpr double least = 1e-3;  // inverse condition number that counts as regular
  const double unit = unit_of_length(arm);
  const auto inverse_condition = [&](const Configuration& at) {
    return 1 / manipulability_measures(task_jacobian(arm, at, task, unit)).condition;
  };
  std::optional<int> found;
  double best = std::max(least, 10 * inverse_condition(q));
  for (int k = 0; k < arm.dof(); ++k) {
    const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
    for (const double side : {change, -change}) {
      Configuration moved = q;
      moved[k] += slides ? side * unit : side;
      const double regular = inverse_condition(moved);
      if (regular <= best) continue;
      best = regular;
      found = k;
    }
  }
  return found;
}

}  // namespace beeline::internal
