#include <beeline/batch/internal/copies.h>
#include <beeline/batch/internal/parallel.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/reach/internal/branch_solver.h>
#include <beeline/reach/internal/branches.h>

namespace beeline::internal {
namespace {

void check_joints(const Arm& arm) {
  const int rows = default_task(arm).size();
  // The tool of a SCARA keeps its z axis: four joints reach all other poses.
  const int needed = arm.rotates_about_z() && !arm.planar() ? 4 : rows;
  if (arm.dof() >= needed) return;
  throw Error(
      "arm " + arm.name() + " has " + std::to_string(arm.dof()) +
      " joints, so that it reaches almost no pose at the centre of a cell; a map by sampling "
      "has the cells that it reaches anywhere");
}

void check_in_scene(const ReachGrid& grid) {
  if (grid.cylindrical()) {
    throw Error::of("azimuths",
                    "a scene is not the same from all azimuths: make a map without azimuths");
  }
  if (grid.orientations() == ReachOrientations::directions) {
    throw Error::of("rolls",
                    "in a scene a direction cannot have any roll, because the last joint moves the "
                    "bodies on the last link: give the angle between rolls");
  }
}

/// Whether a pose is solved by all its solutions, and there are finitely many.
bool has_all_solutions(const Arm& arm) {
  return arm.dof() <= default_task(arm).size() && has_closed_form(arm, {.all = true});
}

}  // namespace

FreeJoints free_joints(const Arm& arm, const ReachGrid& grid, bool in_scene) {
  if (grid.orientations() == ReachOrientations::any) {
    throw Error::of("any_orientation",
                    "a map of any orientation is one by sampling: give the number of samples");
  }
  check_joints(arm);
  if (in_scene) {
    check_in_scene(grid);
    return {};
  }
  FreeJoints free{.any_roll = grid.orientations() == ReachOrientations::directions};
  const bool all = has_all_solutions(arm);
  if (free.any_roll || (all && grid.orientations() == ReachOrientations::rolls)) {
    free.roll = roll_joint(arm);
  }
  if (free.any_roll && !free.roll) {
    throw Error(
        "the last joint of " + arm.name() +
        " does not rotate the tool about its own z axis, so that reaching a direction takes "
        "a roll: give the angle between rolls, too");
  }
  if (grid.cylindrical()) {
    if (!all) {
      throw Error::of(
          "azimuths",
          "the solutions of a pose of " + arm.name() +
              " cannot all be computed, as a map by azimuths needs: make one without azimuths");
    }
    free.base = base_joint(arm);
  }
  return free;
}

Arm with_free_joints(const Arm& arm, const FreeJoints& free) {
  Arm freed = arm;
  if (free.base) freed = without_limits(freed, *free.base);
  if (free.roll) freed = without_limits(freed, *free.roll);
  return freed;
}

void ReachBranches::append(const ReachBranches& others) {
  const std::size_t before = first_joint.size();
  for (const std::size_t end : others.ends) ends.push_back(before + end);
  const auto join = [](auto& all, const auto& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  join(counts, others.counts);
  join(first_joint, others.first_joint);
  join(last_joint, others.last_joint);
  join(manipulability, others.manipulability);
  join(margin, others.margin);
}

ReachBranches reach_branches(const Arm& arm, const ReachGrid& grid, Eigen::Index first,
                             Eigen::Index last, const ReachOptions& options) {
  const FreeJoints free = free_joints(arm, grid, static_cast<bool>(options.blocked_by));
  BudgetMeter budget(options.budget);
  Copies<BranchSolver> solvers(BranchSolver(arm, free, options.redundant_values));
  const Eigen::Index block = block_of_positions(free.solved_orientations(grid));
  std::vector<ReachBranches> blocks(static_cast<std::size_t>((last - first + block - 1) / block));
  const Eigen::Index cells = grid.azimuths() * grid.directions() * grid.rolls();
  FinishedSteps solved(budget, last - first);
  in_parallel(last - first, block, options.threads, [&](Eigen::Index a, Eigen::Index b) {
    if (budget.ended((b - a) * cells)) return;
    const auto solver = solvers.borrow();
    solver->solve(grid, first + a, first + b);
    blocks[static_cast<std::size_t>(a / block)] = solver->take();
    solved.add(b - a);
  });
  ReachBranches all{.ending = budget.ending()};
  for (const ReachBranches& some : blocks) all.append(some);
  return all;
}

}  // namespace beeline::internal
