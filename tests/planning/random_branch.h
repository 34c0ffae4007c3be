#pragma once

#include <optional>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/path/blend.h>
#include <beeline/planning/branch.h>

#include <tests/path/random_line.h>

namespace beeline::testing {

/// A complete branch of an arm along a route without stops, and what it was planned with.
struct RandomBranch {
  Arm arm;
  Route route;
  Task task;
  Branch branch;
};

/// Blended lines, a spline or one line through nearby poses; none where the arm cannot.
inline std::optional<RandomBranch> random_branch(Random& random, const std::string& arm_name,
                                                 const Deviation& tolerance) {
  const Arm arm = built_in(arm_name);
  const Task task = default_task(arm);
  const Configuration q = inner_configuration(random, arm);
  std::vector<Pose> poses{forward_kinematics(arm, q)};
  const int kind = random.integer(0, 2);
  for (int i = kind == 0 ? 1 : random.integer(2, 4); i > 0; --i) {
    poses.push_back(nearby_pose(random, arm, poses.front()));
  }
  Route route;
  if (kind == 2) {
    const BlendedPath blended = blended_lines(poses, {0.03, 0.3});
    for (const bool sharp : blended.stops) {
      if (sharp) return std::nullopt;
    }
    route.path = blended.path;
  } else {
    route.path = path_through(poses, kind == 0 ? PathKind::line : PathKind::spline);
  }
  route.stops.assign(route.path.segments.size(), false);
  Branch branch = plan_path(arm, q, route.path, {.task = task, .tolerance = tolerance});
  if (!branch || branch.inverse_condition < 0.02) return std::nullopt;
  return RandomBranch{arm, std::move(route), task, std::move(branch)};
}

}  // namespace beeline::testing
