// Reach: what a UR5e can do around it, a picture of that, and where it can stand to reach three
// poses.
#include <iostream>
#include <numbers>

#include <beeline/draw/figure.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>
#include <beeline/reach/place.h>

int main() {
  constexpr double deg = std::numbers::pi / 180;
  const beeline::Arm arm = beeline::built_in("ur5e");
  const beeline::ReachGrid grid(arm, {.resolution = 0.15, .directions = 45 * deg});
  const beeline::ReachMap map({arm, grid}, reach_cells(arm, grid, 0, grid.positions()));
  const beeline::ReachMap::Totals totals = map.totals();
  std::cout << totals.reached << " of " << totals.cells << " cells reached, at "
            << totals.reached_positions << " of " << totals.positions << " positions\n";
  save(reach_figure(slice_of(map, 2, 0.3)), "12_reach.svg");

  const beeline::Rotation down = beeline::rotation(beeline::RollPitchYaw{.roll = 180 * deg});
  const std::vector<beeline::Pose> poses{beeline::make_pose({0.8, -0.3, 0.2}, down),
                                         beeline::make_pose({0.8, 0.3, 0.2}, down),
                                         beeline::make_pose({1.0, 0.0, 0.4}, down)};
  const beeline::PlacementResult found = find_placements(map, poses, {.count = 1});
  if (!found) {
    std::cout << reason_of(found) << '\n';
    return 1;
  }
  const beeline::Placement& best = found.placements.front();
  std::cout << found.reaching << " of " << found.checked << " mounts reach the poses; the best is "
            << best.world_T_mount.translation().transpose() << " m, turned by "
            << best.heading / deg << " degrees, margin " << best.margin << '\n';

  const beeline::Arm there = with_mount(arm, best.world_T_mount);
  double error = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const beeline::Pose tool = forward_kinematics(there, best.solutions[i]);
    error = std::max(error, (tool.matrix() - poses[i].matrix()).cwiseAbs().maxCoeff());
  }
  return error < 1e-6 ? 0 : 1;
}
