#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <beeline/batch/batch.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/reach/internal/cell_solver.h>

namespace beeline::internal {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

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

/// The arm's roll joint where it is used: for cells with any roll or several rolls.
std::optional<RollJoint> used_roll_joint(const Arm& arm, const ReachGrid& grid) {
  check_joints(arm);
  std::optional<RollJoint> roll;
  if (grid.orientations() == ReachOrientations::rolls ||
      grid.orientations() == ReachOrientations::directions) {
    roll = roll_joint(arm);
  }
  if (grid.orientations() == ReachOrientations::directions && !roll) {
    throw Error(
        "the last joint of " + arm.name() +
        " does not rotate the tool about its own z axis, so that reaching a direction takes "
        "a roll: give the angle between rolls, too");
  }
  // The redundant joint of the arm with a free roll may be another one.
  const bool redundant = arm.dof() > default_task(arm).size();
  if (redundant && grid.orientations() == ReachOrientations::rolls) roll.reset();
  return roll;
}

/// The rows of which the manipulability is measured.
Task measured_rows(const Arm& arm) {
  const bool scara = arm.rotates_about_z() && !arm.planar() && arm.dof() < 6;
  return scara ? Task{{true, true, true, false, false, true}} : default_task(arm);
}

}  // namespace

CellSolver::CellSolver(const Arm& arm, const ReachGrid& grid, int redundant_values)
    : arm_(arm),
      grid_(grid),
      rows_(measured_rows(arm)),
      roll_(used_roll_joint(arm, grid)),
      any_roll_(grid.orientations() == ReachOrientations::directions),
      solver_(roll_ ? with_free_roll(arm) : arm, redundant_values) {}

void CellSolver::add_turned(double roll, Eigen::Index target, ReachCells& cells) {
  const auto found = solver_.solutions();
  const Eigen::Index last = found.rows() - 1;
  int branches = 0;
  for (Eigen::Index i = 0; i < found.cols(); ++i) {
    Configuration q = found.col(i);
    if (roll_ && !any_roll_) {
      const std::optional<double> turned = roll_->turned(arm_, q[last], roll);
      if (!turned) continue;
      q[last] = *turned;
    }
    solutions_.insert(solutions_.end(), q.begin(), q.end());
    targets_.push_back(target);
    ++branches;
  }
  const bool all = branches == found.cols();
  cells.branches[target] = static_cast<std::uint8_t>(all ? solver_.branches() : branches);
}

void CellSolver::solve_direction(Eigen::Index p, Eigen::Index d, Eigen::Index target,
                                 ReachCells& cells) {
  const Eigen::Index rolls = grid_.rolls();
  const double step = 2 * std::numbers::pi / static_cast<double>(rolls);
  for (Eigen::Index r = 0; r < rolls; ++r) {
    if (r == 0 || !roll_) solver_.solve(grid_.pose((p * grid_.directions() + d) * rolls + r));
    add_turned(static_cast<double>(r) * step, target + r, cells);
  }
}

void CellSolver::measure(ReachCells& cells) {
  const auto count = static_cast<Eigen::Index>(targets_.size());
  const Eigen::Map<const Eigen::MatrixXd> q(solutions_.data(), arm_.dof(), count);
  Eigen::MatrixXd manipulability(1, count);
  if (rows_ == Task::spatial()) {
    batch_manipulability<double>(arm_, q, manipulability, {.threads = 1});
  } else {
    for (Eigen::Index i = 0; i < count; ++i) {
      manipulability(i) =
          manipulability_measures(task_jacobian(arm_, q.col(i), rows_)).manipulability;
    }
  }
  const auto raise = [](float& best, double value) {
    if (!(best >= static_cast<float>(value))) best = static_cast<float>(value);
  };
  const int joints = arm_.dof() - (any_roll_ ? 1 : 0);
  for (Eigen::Index i = 0; i < count; ++i) {
    raise(cells.manipulability[targets_[i]], manipulability(i));
    raise(cells.margin[targets_[i]], least_margin(arm_, q.col(i), joints));
  }
  solutions_.clear();
  targets_.clear();
}

void CellSolver::solve(Eigen::Index first, Eigen::Index last, Eigen::Index origin,
                       ReachCells& cells) {
  const Eigen::Index at_position = grid_.directions() * grid_.rolls();
  const auto begin = (first - origin) * at_position, end = (last - origin) * at_position;
  std::fill(cells.manipulability.begin() + begin, cells.manipulability.begin() + end, unknown);
  std::fill(cells.margin.begin() + begin, cells.margin.begin() + end, unknown);
  for (Eigen::Index p = first; p < last; ++p) {
    for (Eigen::Index d = 0; d < grid_.directions(); ++d) {
      solve_direction(p, d, (p - origin) * at_position + d * grid_.rolls(), cells);
    }
  }
  measure(cells);
}

}  // namespace beeline::internal
