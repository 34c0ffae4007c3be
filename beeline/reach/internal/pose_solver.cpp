#include <algorithm>
#include <bit>
#include <numbers>
#include <utility>

#include <beeline/inverse/internal/arm_defaults.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/kinematics/forward.h>
#include <beeline/reach/internal/pose_solver.h>

namespace beeline::internal {
namespace {

// The closed forms have up to 16 solutions. Poses that are solved numerically can have more.
constexpr Eigen::Index most_at_once = 32;

/// Returns the coordinate at whose values the arm has a closed form; none for an arm that is not
/// redundant.
std::optional<int> redundant_joint(const Arm& arm) {
  if (arm.dof() <= default_task(arm).size()) return std::nullopt;
  const Pose reached = forward_kinematics(arm, middle_configuration(arm));
  const InverseResult result =
      inverse_kinematics(arm, reached, {.task = default_task(arm), .all = true, .grid = 2});
  if (!result.grid) return std::nullopt;
  return result.grid->joint;
}

/// Equal steps over the range of a joint, or over a revolution.
std::vector<double> steps_over_range(const Limits& limits, int count) {
  const bool bounded = limits.upper < Limits::none && limits.lower > -Limits::none;
  const double lower = bounded ? limits.lower : -std::numbers::pi;
  const double range = bounded ? limits.upper - limits.lower : 2 * std::numbers::pi;
  std::vector<double> values(count);
  for (int i = 0; i < count; ++i) values[i] = lower + range * (i + 0.5) / count;
  return values;
}

}  // namespace

PoseSolver::PoseSolver(const Arm& arm, int redundant_values, BlockedBy blocked_by)
    : arm_(arm),
      any_{.task = default_task(arm), .redundancy = Redundancy::any},
      any_free_{.task = default_task(arm), .blocked_by = blocked_by, .redundancy = Redundancy::any},
      redundant_(redundant_joint(arm)),
      volume_(Kept<ArmDefaults>(arm)->volume),
      seed_(middle_configuration(arm)),
      blocked_by_(std::move(blocked_by)) {
  if (redundant_) {
    values_ = steps_over_range(arm.limits(*redundant_), redundant_values);
    form_ = PieperSolver::make(arm, default_task(arm));
    if (form_ && form_->locked() != redundant_) form_.reset();
  }
  if (form_) {
    const Bounds bounds = bounds_of(arm);
    loop_ = form_->request(seed_, Configuration::Ones(arm.dof()), bounds.lower, bounds.upper);
  } else {
    const InverseOptions all{.task = default_task(arm), .all = true, .lock = redundant_};
    if (has_closed_form(arm, all)) all_ = all;
  }
  const auto passes = static_cast<Eigen::Index>(values_.size());
  found_.resize(arm.dof(), (passes + 1) * most_at_once);
}

bool PoseSolver::is_new(const ConfigurationRef& q, Eigen::Index first) const {
  // Two branches merge at the boundary of the workspace.
  constexpr double same = 1e-4;  // radians or metres
  for (Eigen::Index i = first; i < count_; ++i) {
    if ((found_.col(i) - q).cwiseAbs().maxCoeff() < same) return false;
  }
  return true;
}

void PoseSolver::add_branches(const Pose& world_T_tool, double value) {
  PieperBranches branches;
  form_->branches(world_T_tool, value, loop_, branches);
  const Eigen::Index first = count_;
  for (unsigned rest = branches.within; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    if (!(branches.residual[lane] <= loop_.max_residual)) continue;
    form_->configuration(branches, lane, value, found_.col(count_).data());
    if (is_new(found_.col(count_), first)) ++count_;
  }
  keep_free(first);
}

void PoseSolver::keep_free(Eigen::Index first) {
  has_solution_ = has_solution_ || count_ > first;
  if (blocked_by_) {
    const Eigen::Index end = std::exchange(count_, first);
    for (Eigen::Index i = first; i < end; ++i) {
      Reason blocked = blocked_by_(found_.col(i));
      if (blocked) {
        blocked_ = std::move(blocked);
        continue;
      }
      if (i != count_) found_.col(count_) = found_.col(i);
      ++count_;
    }
  }
  branches_ = std::max(branches_, static_cast<int>(count_ - first));
}

void PoseSolver::add_all(const Pose& world_T_tool, const InverseOptions& options) {
  const Eigen::Index first = count_;
  count_ += inverse_kinematics(arm_, world_T_tool, seed_, found_.middleCols(first, most_at_once),
                               options);
  keep_free(first);
}

void PoseSolver::solve(const Pose& world_T_tool) {
  count_ = branches_ = 0;
  has_solution_ = false;
  blocked_ = {};
  if (volume_.excludes(world_T_tool, *any_.task, any_.tolerance,
                       /*ignore_limits=*/false))
    return;
  if (all_ && !redundant_) {
    add_all(world_T_tool, *all_);
    // Along a self-motion, each branch is represented by one of its solutions.
    if (has_solution_ && count_ == 0) add_all(world_T_tool, any_free_);
    return;
  }
  const Configuration middle = seed_;
  for (const double value : values_) {
    if (form_) {
      add_branches(world_T_tool, value);
    } else if (all_) {
      seed_[*redundant_] = value;
      add_all(world_T_tool, *all_);
    }
  }
  seed_ = middle;
  if (has_solution_) return;
  add_all(world_T_tool, any_);
  if (has_solution_ && count_ == 0) add_all(world_T_tool, any_free_);
}

}  // namespace beeline::internal
