#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/error.h>
#include <beeline/inverse/planar.h>
#include <beeline/inverse/reason.h>
#include <beeline/inverse/representative.h>
#include <beeline/inverse/search.h>
#include <beeline/inverse/solve.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/angle.h>

namespace beeline {
namespace {

/// Everything that is asked, checked and with its defaults filled in.
struct Question {
  const Arm& arm;
  Pose goal;
  Task task;
  Configuration seed;
  Bounds bounds;  ///< the limits, or none where these do not count
  double tolerance = 0;
  InverseOptions options;
};

double largest(const Deviation& error) { return std::max(error.position, error.orientation); }

Pose checked_pose(const Pose& pose) {
  constexpr double farthest = 1e100;  // beyond, squares overflow
  constexpr double rounding = 1e-6;   // of a rotation that was read from text
  if (!pose.matrix().allFinite() || pose.translation().cwiseAbs().maxCoeff() > farthest) {
    throw Error("the pose has a number that is not finite, or a position beyond 1e100 m");
  }
  const Rotation r = pose.linear();
  if (!(r * r.transpose()).isIdentity(rounding) || r.determinant() < 0) {
    throw Error("the pose is no rigid motion: its rotation must be orthonormal and right-handed");
  }
  Pose rigid = pose;
  rigid.linear() = Eigen::Quaterniond(r).normalized().toRotationMatrix();
  return rigid;
}

/// Forward kinematics rounds off about this much of the arm's size.
double rounding_of(const Arm& arm, const Pose& goal) {
  const double reach = std::isfinite(arm.reach().radius) ? arm.reach().radius : 0;
  const double size = std::max(reach, goal.translation().norm());
  return 16 * std::numeric_limits<double>::epsilon() * size *
         std::sqrt(static_cast<double>(arm.joints().size()));
}

Question checked(const Arm& arm, const Pose& world_T_tool, const InverseOptions& options) {
  Question ask{arm,
               checked_pose(world_T_tool),
               options.task.value_or(default_task(arm)),
               options.seed.value_or(middle_configuration(arm)),
               options.ignore_limits ? no_bounds(arm) : bounds_of(arm),
               options.tolerance,
               options};
  check_configuration(arm, ask.seed);
  if (ask.task.size() == 0 || ask.task.frame == Frame::space) {
    throw Error("the task needs at least one row, and the base or the tool frame");
  }
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance)) {
    throw Error("tolerance is " + number(options.tolerance) + "; it must be above zero");
  }
  if (options.iterations < 0 || options.restarts < 0) {
    throw Error("iterations is " + std::to_string(options.iterations) + " and restarts " +
                std::to_string(options.restarts) + "; neither may be negative");
  }
  ask.tolerance = std::max(options.tolerance, rounding_of(arm, ask.goal));
  return ask;
}

double error_at(const Question& ask, const Configuration& q) {
  return largest(task_deviation(ask.task, ask.goal, forward_kinematics(ask.arm, q)));
}

/// Adds q to the solutions, by the turns nearest to the seed, if so it is within limits and forward
/// kinematics confirms it. `q` is a posture that some method claims to be a solution.
void confirm(const Question& ask, const Configuration& q, InverseResult& result) {
  // Next to a singular solution a value is known to the square root of rounding only.
  constexpr double hair = 1e-6;
  Configuration turned = nearest_representative(ask.arm, q, ask.seed, ask.bounds);
  if (excess(ask.bounds, turned) > hair) return;
  turned = turned.cwiseMax(ask.bounds.lower).cwiseMin(ask.bounds.upper);
  if (!(error_at(ask, turned) <= ask.tolerance)) {
    // It was set on a bound, or lost its digits in turns far from zero.
    const Configuration& near = within(ask.bounds, q) ? q : turned;
    turned = descend(ask.arm, ask.goal, ask.task, ask.bounds, near, {.tolerance = ask.tolerance}).q;
    if (!(error_at(ask, turned) <= ask.tolerance)) return;
  }
  result.solutions.push_back(turned);
}

InverseResult refused(InverseResult result, InverseStatus status, double residual,
                      const std::string& reason) {
  result.status = status;
  result.residual = residual;
  result.reason = reason;
  return result;
}

/// Sorts what was found and leaves out what was not asked for.
InverseResult solved(const Question& ask, InverseResult result) {
  result.status = InverseStatus::solved;
  std::sort(result.solutions.begin(), result.solutions.end(),
            [&ask](const Configuration& a, const Configuration& b) {
              const double to_a = (a - ask.seed).norm(), to_b = (b - ask.seed).norm();
              if (to_a != to_b) return to_a < to_b;
              return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
            });
  if (!ask.options.all) result.solutions.resize(1);
  result.residual = 0;
  for (const Configuration& q : result.solutions) {
    result.residual = std::max(result.residual, error_at(ask, q));
  }
  return result;
}

Search search_within(const Question& ask, const Bounds& bounds, Configuration start, bool all,
                     InverseResult& result) {
  for (int k = 0; k < ask.arm.dof(); ++k) {
    const bool open = !std::isfinite(bounds.lower[k]) && !std::isfinite(bounds.upper[k]);
    if (open && turns_around(ask.arm, k)) start[k] = wrap_angle(start[k]);  // keeps its digits
  }
  Search found = search(ask.arm, ask.goal, ask.task, bounds, start,
                        {.tolerance = ask.tolerance,
                         .iterations = ask.options.iterations,
                         .restarts = ask.options.restarts,
                         .all = all,
                         .random_seed = ask.options.random_seed});
  result.iterations += found.iterations;
  result.restarts += found.restarts;
  for (const Configuration& q : found.solutions) confirm(ask, q, result);
  return found;
}

std::string tries(const Question& ask) {
  const int count = ask.options.restarts + 1;
  return std::to_string(count) + (count == 1 ? " try" : " tries");
}

InverseResult closed_form(const Question& ask) {
  InverseResult result;
  result.method = "planar closed form";
  const PlanarSolution* best = nullptr;     // by what is missing
  const PlanarSolution* outside = nullptr;  // of those that reach, by how far limits are exceeded
  bool continuum = false;
  const auto beyond_limits = [&ask](const Configuration& q) {
    return excess(ask.bounds, nearest_representative(ask.arm, q, ask.seed, ask.bounds));
  };
  const std::vector<PlanarSolution> candidates =
      nearest_planar_solutions(ask.arm, ask.goal, ask.task, ask.seed, ask.tolerance);
  for (const PlanarSolution& candidate : candidates) {
    if (best == nullptr || largest(candidate.error) < largest(best->error)) best = &candidate;
    if (!(largest(candidate.error) <= ask.tolerance)) continue;
    continuum = continuum || candidate.continuum;
    if (outside == nullptr || beyond_limits(candidate.q) < beyond_limits(outside->q)) {
      outside = &candidate;
    }
    confirm(ask, candidate.q, result);
  }
  if (outside == nullptr) {
    const bool oriented = ask.task == Task::planar();
    // The candidates have the very orientation; a coarse tolerance might trade some of it.
    const bool proved = ask.tolerance <= 1e-6;
    return refused(result, proved ? InverseStatus::unreachable : InverseStatus::not_found,
                   largest(best->error),
                   "the pose is out of reach: " +
                       std::string(oriented ? "with the orientation asked for, " : "") +
                       "the tool of arm " + ask.arm.name() + " comes no nearer than " +
                       miss(best->error, ask.tolerance));
  }
  double residual = 0;
  if (result.solutions.empty() && continuum) {  // others of the infinitely many may be within
    residual = largest(search_within(ask, ask.bounds, outside->q, false, result).nearest.error);
  }
  if (!result.solutions.empty()) return solved(ask, result);
  const Configuration q = nearest_representative(ask.arm, outside->q, ask.seed, ask.bounds);
  return refused(result, InverseStatus::outside_limits, residual,
                 (continuum ? "no solution within the joint limits was found in " + tries(ask)
                            : std::string("every solution is outside the joint limits")) +
                     "; in the nearest one " + blocking_joint(ask.arm, q, ask.bounds));
}

/// Looks without limits for what a search within them missed: a posture whose turns fit, or one
/// from whose nearest corner of the limits a descent arrives. Returns the solution that exceeds the
/// limits least, if there is any.
std::optional<Configuration> search_beyond(const Question& ask, InverseResult& result) {
  const Search found = search_within(ask, no_bounds(ask.arm), ask.seed, true, result);
  std::optional<Configuration> least;
  for (const Configuration& q : found.solutions) {
    if (!result.solutions.empty()) break;
    const Configuration turned = nearest_representative(ask.arm, q, ask.seed, ask.bounds);
    if (!least || excess(ask.bounds, turned) < excess(ask.bounds, *least)) least = turned;
    const Descent run = descend(ask.arm, ask.goal, ask.task, ask.bounds, turned,
                                {.tolerance = ask.tolerance, .iterations = ask.options.iterations});
    result.iterations += run.iterations;
    if (run.converged) confirm(ask, run.q, result);
  }
  return least;
}

/// `far` says that limits keep the pose out of reach, so that there is nothing to search within.
InverseResult numerical(const Question& ask, const std::optional<Obstacle>& far) {
  InverseResult result;
  result.method = "numerical";
  Deviation nearest;
  if (!far) {
    nearest = search_within(ask, ask.bounds, ask.seed, ask.options.all, result).nearest.error;
    if (!result.solutions.empty()) return solved(ask, result);
  }
  if (ask.bounds.lower.array().isFinite().any() || ask.bounds.upper.array().isFinite().any()) {
    const std::optional<Configuration> beyond = search_beyond(ask, result);
    if (!result.solutions.empty()) return solved(ask, result);
    if (beyond && excess(ask.bounds, *beyond) > 0) {
      const std::string none_within =
          far ? far->reason : "no solution within the joint limits was found in " + tries(ask);
      return refused(
          result, InverseStatus::outside_limits, largest(nearest),
          none_within + "; without limits " + blocking_joint(ask.arm, *beyond, ask.bounds));
    }
  }
  if (far) return refused(result, InverseStatus::unreachable, far->missing, far->reason);
  return refused(result, InverseStatus::not_found, largest(nearest),
                 "no solution was found in " + tries(ask) + "; the nearest misses by " +
                     miss(nearest, ask.tolerance) + "; that none exists is not proved");
}

}  // namespace

std::string name(InverseStatus status) {
  constexpr const char* names[] = {"solved", "unreachable", "outside_limits", "not_found"};
  return names[static_cast<int>(status)];
}

InverseResult inverse_kinematics(const Arm& arm, const Pose& world_T_tool,
                                 const InverseOptions& options) {
  const Question ask = checked(arm, world_T_tool, options);
  const auto proved = [](const Obstacle& obstacle) {
    InverseResult result;
    result.method = "reach";
    return refused(result, InverseStatus::unreachable, obstacle.missing, obstacle.reason);
  };
  if (const auto stays = against_what_stays(arm, ask.goal, ask.task, ask.tolerance)) {
    return proved(*stays);
  }
  std::optional<Obstacle> far = beyond_reach(arm, ask.goal, ask.task, ask.tolerance);
  if (far && !limits_bound_reach(arm)) return proved(*far);
  if (options.ignore_limits) far.reset();
  return has_planar_closed_form(arm, ask.task) ? closed_form(ask) : numerical(ask, far);
}

}  // namespace beeline
