#include <algorithm>
#include <cmath>

#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/pose_configurations.h>
#include <beeline/planning/internal/self_motion_starts.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_candidates = 64, max_redundant_candidates = 12;
constexpr int coarse_grid = 6;

/// Seconds of a joint move at the velocity limits.
double least_duration(const Arm& arm, const Configuration& from, const Configuration& to) {
  double duration = 0;
  for (int k = 0; k < arm.dof(); ++k) {
    duration = std::max(duration, std::abs(to[k] - from[k]) / velocity_limit_of(arm.limits(k)));
  }
  return duration;
}

}  // namespace

std::vector<Configuration> configurations_for(
    const Arm& arm, const Task& task, const Pose& pose, const Configuration& from,
    const Budget& budget, const decltype(InverseOptions::blocked_by)& blocked_by) {
  const bool redundant = is_redundant(arm, task);
  InverseOptions options{
      .seed = from, .task = task, .all = true, .every_turn = !redundant, .budget = budget};
  std::vector<Configuration> found;
  if (redundant) {
    options.method = method_for_few_poses(arm, task);
    options.grid = coarse_grid;
    options.max_restarts = 4 * coarse_grid;
    found = inverse_kinematics(
                arm, pose,
                {.seed = from, .task = task, .redundancy = Redundancy::nearest, .budget = budget})
                .solutions;
  }
  const InverseResult all = inverse_kinematics(arm, pose, options);
  found.insert(found.end(), all.solutions.begin(), all.solutions.end());
  const auto is_free = [&](const Configuration& q) { return !blocked_by(q); };
  const bool all_blocked = blocked_by && std::none_of(found.begin(), found.end(), is_free);
  if (redundant && all_blocked && !found.empty()) {
    const InverseOptions finer{.seed = from,
                               .task = task,
                               .method = options.method,
                               .all = true,
                               .blocked_by = blocked_by,
                               .budget = budget};
    std::vector<Configuration> free = inverse_kinematics(arm, pose, finer).solutions;
    if (!free.empty()) found = std::move(free);
  }
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    return least_duration(arm, from, a) < least_duration(arm, from, b);
  });
  if (blocked_by) std::stable_partition(found.begin(), found.end(), is_free);
  const std::size_t most = redundant ? max_redundant_candidates : max_candidates;
  if (found.size() > most) found.resize(most);
  return found;
}

InverseResult solution_for(const Arm& arm, const Task& task, const Pose& pose,
                           const Configuration& from, const Budget& budget) {
  InverseResult found =
      inverse_kinematics(arm, pose, {.seed = from, .task = task, .budget = budget});
  explain(found, budget);
  return found;
}

}  // namespace beeline::internal
