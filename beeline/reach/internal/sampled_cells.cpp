#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

#include <beeline/batch/batch.h>
#include <beeline/batch/internal/parallel.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/reach/internal/sampled_cells.h>
#include <beeline/reach/internal/solution_measures.h>
#include <beeline/reach/internal/turning_joint.h>

namespace beeline::internal {
namespace {

/// The samples of an arm's joint ranges.
class Samples {
 public:
  explicit Samples(const Arm& arm) : lower_(arm.dof()), range_(arm.dof()), steps_(arm.dof()) {
    const int dof = arm.dof();
    // The positive root of x^(dof + 1) = x + 1.
    double root = 2;
    for (int i = 0; i < 64; ++i) root = std::pow(1 + root, 1.0 / (dof + 1));
    for (int k = 0; k < dof; ++k) {
      const auto [lower, upper] = range_of(arm, k);
      lower_[k] = lower;
      range_[k] = upper - lower;
      steps_[k] = static_cast<std::uint64_t>(std::ldexp(std::pow(root, -(k + 1)), 64));
    }
  }

  /// Configurations number `first` and on, one in each column.
  void write(std::int64_t first, Eigen::Ref<Eigen::MatrixXd> q) const {
    for (Eigen::Index i = 0; i < q.cols(); ++i) {
      const auto number = static_cast<std::uint64_t>(first + i) + 1;
      for (Eigen::Index k = 0; k < q.rows(); ++k) {
        const std::uint64_t fraction = number * steps_[static_cast<std::size_t>(k)];  // mod 1
        q(k, i) = lower_[k] + range_[k] * (static_cast<double>(fraction) * 0x1p-64);
      }
    }
  }

 private:
  /// Returns the range of a coordinate. For a revolute joint that no other joint follows, it is at
  /// most a revolution around the middle of the limits.
  static std::pair<double, double> range_of(const Arm& arm, int k) {
    const Limits& limits = arm.limits(k);
    const bool bounded = limits.upper < Limits::none && limits.lower > -Limits::none;
    // If other joints follow the joint, a further revolution is another configuration.
    const bool alone = turns_alone(arm, k);
    if (!bounded && !alone) {
      throw Error("joint " + arm.joint_of(k).name + " of " + arm.name() +
                  " has no position limits, which a map by sampling needs of joints that are not "
                  "revolute, or that others follow");
    }
    constexpr double half = std::numbers::pi;
    if (!bounded) return {-half, half};
    if (!alone || limits.upper - limits.lower <= 2 * half) return {limits.lower, limits.upper};
    const double middle = (limits.lower + limits.upper) / 2;
    return {middle - half, middle + half};
  }

  Eigen::VectorXd lower_, range_;
  std::vector<std::uint64_t> steps_;  // fractions of 1, times 2^64
};

/// Adds a sample to its cell.
void add(ReachCells& cells, Eigen::Index cell, float manipulability, float margin) {
  constexpr auto most = std::numeric_limits<std::uint8_t>::max();
  if (cells.branches[cell] < most) ++cells.branches[cell];
  keep_max(cells.manipulability[cell], manipulability);
  keep_max(cells.margin[cell], margin);
}

void check_grid(const Arm& arm, const ReachGrid& grid) {
  if (grid.cylindrical()) {
    throw Error("a map by sampling has positions by x, y and z: leave out the azimuths");
  }
  if (grid.orientations() == ReachOrientations::fixed) {
    throw Error::of("orientation",
                    "no sample has exactly the orientation of the map: give directions of " +
                        arm.name() + ", or any orientation");
  }
}

}  // namespace

ReachCells sampled_cells(const Arm& arm, const ReachGrid& grid, Eigen::Index first,
                         Eigen::Index last, const ReachOptions& options) {
  check_grid(arm, grid);
  const Samples samples(arm);
  const Eigen::Index at_position = grid.directions() * grid.rolls();
  const Eigen::Index begin = first * at_position, end = last * at_position;
  ReachCells cells;
  if (begin == end) return cells;
  cells.resize(static_cast<std::size_t>(end - begin));
  std::fill(cells.manipulability.begin(), cells.manipulability.end(),
            std::numeric_limits<float>::quiet_NaN());
  cells.margin = cells.manipulability;
  // If any roll is accepted, the margin is the smallest margin of the other joints.
  const bool any_roll = grid.orientations() == ReachOrientations::directions && roll_joint(arm);
  const int joints = arm.dof() - (any_roll ? 1 : 0);
  BudgetMeter budget(options.budget);
  std::mutex adding;
  FinishedSteps sampled(budget, options.samples);
  constexpr Eigen::Index block = 4096;
  const auto sample = [&](std::int64_t number, Eigen::Index count) {
    if (budget.ended(count)) return;
    Eigen::MatrixXd q(arm.dof(), count), poses(16, count);
    samples.write(number, q);
    batch_forward<double>(arm, q, poses, {.threads = 1});
    std::vector<Eigen::Index> targets;
    Eigen::Index hits = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Pose pose(Eigen::Map<const Eigen::Matrix4d>(poses.col(i).data()));
      const std::optional<Eigen::Index> cell = grid.cell_of(pose);
      if (!cell || *cell < begin || *cell >= end) continue;
      if (options.blocked_by && options.blocked_by(q.col(i))) continue;
      targets.push_back(*cell - begin);
      q.col(hits++) = q.col(i);
    }
    const SolutionMeasures measures = solution_measures(arm, q.leftCols(hits), 0, joints);
    {
      const std::lock_guard lock(adding);  // sums and maxima: in any order the same
      for (std::size_t i = 0; i < targets.size(); ++i) {
        add(cells, targets[i], measures.manipulability[i], measures.margin[i]);
      }
    }
    sampled.add(count);
  };
  // Some at a time: blocks that come after the end of the budget take time, too.
  constexpr std::int64_t at_once = std::int64_t{1} << 24;
  for (std::int64_t begun = 0; begun < options.samples && budget.complete(); begun += at_once) {
    const auto count = static_cast<Eigen::Index>(std::min(at_once, options.samples - begun));
    in_parallel(count, block, options.threads,
                [&](Eigen::Index a, Eigen::Index b) { sample(begun + a, b - a); });
  }
  cells.ending = budget.ending();
  return cells;
}

}  // namespace beeline::internal
