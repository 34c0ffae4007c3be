#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <tuple>

#include <beeline/batch/internal/copies.h>
#include <beeline/batch/internal/parallel.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/internal/tool_plane.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/planning/move_along.h>
#include <beeline/reach/internal/pose_solver.h>
#include <beeline/reach/internal/positions.h>
#include <beeline/reach/internal/solution_measures.h>
#include <beeline/reach/place.h>

namespace beeline {
namespace {

/// The mounts: positions on a grid, headings the fastest.
class Mounts {
 public:
  Mounts(const ReachMap& map, std::span<const Pose> poses, const PlacementOptions& options)
      : headings_(options.headings) {
    const Arm::Reach& reach = map.arm().reach();
    step_ = options.step.value_or(map.grid().axes()[0].step);
    if (!(step_ > 0)) throw Error("the step between mounts is " + number(step_) + " m");
    // However it is turned, the arm reaches at most so far from its mount in x and y.
    const double far = reach.radius + std::hypot(reach.centre.x(), reach.centre.y());
    for (int k = 0; k < 3 && options.lower && options.upper; ++k) {
      if ((*options.lower)[k] <= (*options.upper)[k]) continue;
      throw Error(std::string("the box of the mounts is empty: its lower ") + "xyz"[k] + " is " +
                  number((*options.lower)[k]) + ", its upper one " + number((*options.upper)[k]));
    }
    double mounts = headings_;
    for (int k = 0; k < 3; ++k) {
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (const Pose& pose : poses) {
        least = std::min(least, pose.translation()[k]);
        most = std::max(most, pose.translation()[k]);
      }
      const double within = k == 2 ? 0 : std::ceil((most - far) / step_) * step_;  // round numbers
      lower_[k] = options.lower ? (*options.lower)[k] : within;
      const double upper = options.upper ? (*options.upper)[k] : k == 2 ? lower_[2] : least + far;
      // Poses farther apart than the arm is wide leave no mount.
      counts_[k] = upper < lower_[k] ? 0 : std::floor((upper - lower_[k]) / step_ + 1e-9) + 1;
      mounts *= counts_[k];
    }
    constexpr double max_mounts = 1e8;
    if (!(mounts <= max_mounts)) {
      throw Error::of(
          "step",
          "there would be " + number(mounts) +
              " mounts, at most 1e8 are possible: a larger step or a smaller box has fewer");
    }
    count_ = static_cast<Eigen::Index>(mounts);
  }

  Eigen::Index count() const { return count_; }
  double heading(Eigen::Index i) const {
    return 2 * std::numbers::pi * static_cast<double>(i % headings_) / headings_;
  }
  /// The mount in the world.
  Pose pose(Eigen::Index i) const {
    const Eigen::Index p = i / headings_;
    const auto ny = static_cast<Eigen::Index>(counts_.y()),
               nz = static_cast<Eigen::Index>(counts_.z());
    const Eigen::Index x = p / (ny * nz), y = p / nz % ny, z = p % nz;
    const Vector3 index(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    Pose pose = Pose::Identity();
    pose.linear() = Eigen::AngleAxisd(heading(i), Vector3::UnitZ()).toRotationMatrix();
    pose.translation() = lower_ + step_ * index;
    return pose;
  }

 private:
  int headings_;
  double step_ = 0;
  Vector3 lower_ = Vector3::Zero(), counts_ = Vector3::Zero();
  Eigen::Index count_ = 0;
};

/// Returns the margin of each cell; NaN if it is not reached.
std::vector<float> margins_of(const ReachMap& map, internal::BudgetMeter& budget) {
  std::vector<float> margins;
  margins.reserve(static_cast<std::size_t>(map.grid().cells()));
  const Eigen::Index positions = map.grid().positions();
  const Eigen::Index block = internal::positions_at_once(map.grid());
  for (Eigen::Index first = 0; first < positions && !budget.ended(0); first += block) {
    const ReachCells cells = map.cells(first, std::min(positions, first + block));
    margins.insert(margins.end(), cells.margin.begin(), cells.margin.end());
  }
  return margins;
}

/// The rank of a mount by the map. A smaller rank is better.
struct Rank {
  int unreached = 0;  ///< poses
  float margin = 0;   ///< the negative of the least one
  Eigen::Index mount = 0;

  bool operator<(const Rank& other) const {
    return std::tie(unreached, margin, mount) <
           std::tie(other.unreached, other.margin, other.mount);
  }
};

Rank rank_of(const ReachGrid& grid, const std::vector<float>& margins, const Mounts& mounts,
             Eigen::Index mount, std::span<const Pose> poses) {
  Rank rank{.margin = -1, .mount = mount};
  const Pose mount_T_world = mounts.pose(mount).inverse();
  for (const Pose& pose : poses) {
    const std::optional<Eigen::Index> cell = grid.cell_of(mount_T_world * pose);
    const float margin =
        cell ? margins[static_cast<std::size_t>(*cell)] : std::numeric_limits<float>::quiet_NaN();
    if (std::isnan(margin)) {
      ++rank.unreached;
    } else {
      rank.margin = std::max(rank.margin, -margin);
    }
  }
  return rank;
}

/// The mounts that are checked, the best first; none when the budget ends before.
std::vector<Rank> ranking(const ReachMap& map, const Mounts& mounts, std::span<const Pose> poses,
                          const PlacementOptions& options, internal::BudgetMeter& budget) {
  const std::vector<float> margins = margins_of(map, budget);
  if (!budget.complete()) return {};
  std::vector<Rank> ranks(static_cast<std::size_t>(mounts.count()));
  const Eigen::Index block = std::max<Eigen::Index>(1, 1024 / std::ssize(poses));
  internal::in_parallel(mounts.count(), block, options.threads,
                        [&](Eigen::Index first, Eigen::Index last) {
                          if (budget.ended(0)) return;
                          for (Eigen::Index i = first; i < last; ++i) {
                            ranks[i] = rank_of(map.grid(), margins, mounts, i, poses);
                          }
                        });
  if (!budget.complete()) return {};
  const auto checked = std::min(ranks.size(), static_cast<std::size_t>(options.max_checked));
  std::partial_sort(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(checked),
                    ranks.end());
  ranks.resize(checked);
  return ranks;
}

/// The solution with the largest margin; its margin is negative if there is none.
struct BestSolution {
  double margin = -1;
  Configuration q;
};

BestSolution best_of(const Arm& arm, const Eigen::Ref<const Eigen::MatrixXd>& solutions) {
  BestSolution best;
  for (Eigen::Index i = 0; i < solutions.cols(); ++i) {
    const double margin = internal::least_margin(arm, solutions.col(i), 0, arm.dof());
    if (margin <= best.margin) continue;
    best.margin = margin;
    best.q = solutions.col(i);
  }
  return best;
}

/// The best solution of each pose; none where a pose has none, and `blocked` is then the reason of
/// a blocked one.
std::optional<Placement> placement_at(const Arm& arm, const Pose& world_T_mount,
                                      std::span<const Pose> poses, internal::PoseSolver& solver,
                                      Reason& blocked) {
  Placement placement{.world_T_mount = world_T_mount,
                      .margin = 1,
                      .manipulability = std::numeric_limits<double>::infinity()};
  const Pose mount_T_world = world_T_mount.inverse();
  for (const Pose& pose : poses) {
    solver.solve(mount_T_world * pose);
    BestSolution best = best_of(arm, solver.solutions());
    if (best.margin < 0) {
      blocked = solver.blocked();
      return std::nullopt;
    }
    const Eigen::MatrixXd j = task_jacobian(arm, best.q, default_task(arm));
    placement.margin = std::min(placement.margin, best.margin);
    placement.manipulability =
        std::min(placement.manipulability, manipulability_measures(j).manipulability);
    placement.solutions.push_back(std::move(best.q));
  }
  return placement;
}

void check_options(const ReachMap& map, std::span<const Pose> poses,
                   const PlacementOptions& options) {
  if (poses.empty()) throw Error("there are no poses to reach");
  if (const auto plane = internal::ToolPlane::required(map.arm(), std::nullopt)) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!plane->contains(poses[i])) throw Error(plane->fault("pose " + std::to_string(i + 1)));
    }
  }
  const auto check = [](const char* what, int value, int most) {
    if (value >= 1 && value <= most) return;
    throw Error(std::string(what) + " is " + std::to_string(value) + "; it can be 1 to " +
                std::to_string(most));
  };
  check("headings", options.headings, 360);
  check("count", options.count, 1000);
  check("max_checked", options.max_checked, 100'000'000);
  if (map.grid().orientations() == ReachOrientations::fixed) {
    throw Error("the map has one orientation; a placement needs a map of directions");
  }
  if (map.header().scene) {
    throw Error("the map is of a scene, which would move with the mount: make one without a scene");
  }
  internal::check_complete(map);
  constexpr Eigen::Index most = 500'000'000;
  if (map.grid().cells() > most) {
    throw Error("the map has " + std::to_string(map.grid().cells()) +
                " cells, a placement can use 5e8: make a coarser map");
  }
}

/// What is found at the mounts from which all poses are reached. Threads add to it.
class ReachingMounts {
 public:
  ReachingMounts(const ReachMap& map, std::span<const Pose> poses, const PlacementOptions& options)
      : arm_(map.arm()),
        redundant_values_(map.header().redundant_values),
        poses_(poses),
        options_(options) {}

  /// Checks the mount with this rank and heading.
  void check(Eigen::Index rank, const Pose& world_T_mount, double heading,
             internal::PoseSolver& solver) {
    Reason blocked;
    auto placement = placement_at(arm_, world_T_mount, poses_, solver, blocked);
    if (!placement) return;
    if (options_.blocked_by) {
      const BlockedAtMount there = options_.blocked_by(world_T_mount);
      internal::PoseSolver free(arm_, redundant_values_, there.configuration);
      placement = placement_at(arm_, world_T_mount, poses_, free, blocked);
    }
    const std::lock_guard lock(adding_);
    if (placement) {
      placement->heading = heading;
      free_.push_back(std::move(*placement));
      return;
    }
    if (blocked_ == 0 || rank < first_blocked_) {
      first_blocked_ = rank;
      blocked_reason_ = std::move(blocked);
    }
    ++blocked_;
  }

  /// Sets the counts, and returns the placements, the best first. The result must not depend on the
  /// order of threads, so equal placements are ordered by their mounts.
  std::vector<Placement> take(PlacementResult& result) {
    result.reaching = std::ssize(free_) + blocked_;
    result.blocked = blocked_;
    result.blocked_reason = std::move(blocked_reason_);
    const auto key = [](const Placement& p) {
      const Vector3& at = p.world_T_mount.translation();
      return std::tuple(-p.margin, -p.manipulability, at.x(), at.y(), at.z(), p.heading);
    };
    std::sort(free_.begin(), free_.end(),
              [&key](const Placement& a, const Placement& b) { return key(a) < key(b); });
    return std::move(free_);
  }

 private:
  const Arm& arm_;
  int redundant_values_;
  std::span<const Pose> poses_;
  const PlacementOptions& options_;
  std::mutex adding_;
  std::vector<Placement> free_;
  std::int64_t blocked_ = 0;
  Eigen::Index first_blocked_ = 0;
  Reason blocked_reason_;
};

/// Returns the free mounts from which all poses are reached, the best first.
std::vector<Placement> reaching_mounts(const ReachMap& map, const Mounts& mounts,
                                       std::span<const Pose> poses, const PlacementOptions& options,
                                       internal::BudgetMeter& budget, PlacementResult& result) {
  const std::vector<Rank> ranks = ranking(map, mounts, poses, options, budget);
  internal::Copies<internal::PoseSolver> solvers(
      internal::PoseSolver(map.arm(), map.header().redundant_values));
  ReachingMounts found(map, poses, options);
  internal::FinishedSteps checked(budget, std::ssize(ranks));
  internal::in_parallel(std::ssize(ranks), 16, options.threads,
                        [&](Eigen::Index first, Eigen::Index last) {
                          const auto solver = solvers.borrow();
                          for (Eigen::Index i = first; i < last; ++i) {
                            if (budget.ended(std::ssize(poses))) return;
                            const Eigen::Index mount = ranks[i].mount;
                            found.check(i, mounts.pose(mount), mounts.heading(mount), *solver);
                            checked.add(1);
                          }
                        });
  result.checked = checked.count();
  return found.take(result);
}

/// Sets the duration of the lines through the poses; counts the mount and returns false if the arm
/// cannot follow them.
bool has_lines(const Arm& arm, std::span<const Pose> poses, const PlacementOptions& options,
               internal::BudgetMeter& budget, Placement& placement, PlacementResult& result) {
  PathMotionOptions motion_options;
  motion_options.budget = budget.part();
  if (options.blocked_by) {
    motion_options.blocked_by = options.blocked_by(placement.world_T_mount).motions;
  }
  const PathMotion motion =
      move_in_lines(with_mount(arm, placement.world_T_mount), poses, motion_options);
  if (motion) {
    placement.duration = motion.trajectory.times.back();
    return true;
  }
  ++result.without_lines;
  const bool blocked =
      motion.status == MotionStatus::collides || motion.status == MotionStatus::not_decided;
  result.blocked_lines += blocked;
  return false;
}

}  // namespace

Reason reason_of(const PlacementResult& result) {
  if (result.ending != Ending::complete) {
    return internal::ended_reason(ReasonCode::ended, result.ending);
  }
  if (result) return {};
  if (result.mounts == 0) return {ReasonCode::poses_too_far_apart};
  const auto number = [](std::int64_t n) { return static_cast<std::size_t>(n); };
  if (result.reaching == result.blocked) {
    Reason reason{
        ReasonCode::no_mount_reaches,
        {{ReasonField::count, number(result.checked)}, {ReasonField::of, number(result.mounts)}}};
    if (result.blocked_reason) reason.details.push_back(result.blocked_reason);
    return reason;
  }
  return {ReasonCode::no_mount_moves_in_lines,
          {{ReasonField::count, number(result.without_lines)},
           {ReasonField::of, number(result.reaching - result.blocked)}}};
}

PlacementResult find_placements(const ReachMap& map, std::span<const Pose> world_T_tool,
                                const PlacementOptions& options) {
  check_options(map, world_T_tool, options);
  const Mounts mounts(map, world_T_tool, options);
  PlacementResult result{.mounts = mounts.count()};
  if (mounts.count() == 0) return result;
  internal::BudgetMeter budget(options.budget);
  std::vector<Placement> found =
      reaching_mounts(map, mounts, world_T_tool, options, budget, result);
  const std::int64_t most_refusals = std::max(100, 10 * options.count);
  for (Placement& placement : found) {
    const bool lines = options.lines && world_T_tool.size() > 1;
    if (std::ssize(result.placements) == options.count || result.without_lines == most_refusals ||
        (lines && !budget.complete())) {
      break;
    }
    const auto stands_here = [&placement](const Placement& other) {
      return other.world_T_mount.translation() == placement.world_T_mount.translation();
    };
    if (std::any_of(result.placements.begin(), result.placements.end(), stands_here)) continue;
    if (lines && !has_lines(map.arm(), world_T_tool, options, budget, placement, result)) continue;
    result.placements.push_back(std::move(placement));
  }
  result.ending = budget.ending();
  return result;
}

}  // namespace beeline
