#include <beeline/inverse/numerical/seed_table.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/numerical/seed_table.cpp"
#include <hwy/foreach_target.h>

#include <beeline/kinematics/chain-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using namespace internal;

/// Computes the tool poses (12 rows) of eight configurations, rows of q in units.
void tools(const internal::Chain& chain, const double* q, double* axes, double* tool) {
  const LanePose frame = last_frame(chain, q, axes);
  const double* t = chain.tool.data();
  for (int column = 0; column < 4; ++column) {
    const double* c = t + 4 * column;
    const Vector v = from_axes(frame, {c[0], c[1], c[2]});
    (column == 3 ? frame.origin + v : v).store(tool + 3 * column * lane_count);
  }
}

/// Finds, in each lane, the block b that minimises
///   |weight (origin_b - origin_goal)|^2 - rotation_weight trace(R_goal^T R_b).
void nearest(const double* tool, int blocks, const double* goal, const double* weight,
             double rotation_weight, double* block) {
  Lanes lowest(HUGE_VAL), at(0);
  for (int b = 0; b < blocks; ++b, tool += 12 * lane_count) {
    Lanes score(0), agreement(0);
    for (int r = 0; r < 9; ++r) {
      agreement = fma(Lanes::load(tool + r * lane_count), Lanes(goal[r]), agreement);
    }
    for (int r = 0; r < 3; ++r) {
      const Lanes away = Lanes::load(tool + (9 + r) * lane_count) - Lanes(goal[9 + r]);
      score = fma(away * away, Lanes(weight[r]), score);
    }
    score = fnma(agreement, Lanes(rotation_weight), score);
    const LaneMask less = score < lowest;
    lowest = choose(less, score, lowest);
    at = choose(less, Lanes(b), at);
  }
  at.store(block);
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace beeline {

HWY_EXPORT(tools);
HWY_EXPORT(nearest);

namespace internal {

void draw_configuration(const NumericalProblem& problem, double far, Splitmix& random, double* q) {
  for (std::size_t k = 0; k < problem.coordinates.size(); ++k) {
    const NumericalProblem::Coordinate& coordinate = problem.coordinates[k];
    constexpr double half_turn = 0x1.921fb54442d18p+1, max_angle = 1e4;  // radians
    double away = coordinate.slides ? far : half_turn;
    for (int i = coordinate.first_link; i < coordinate.end_link && !coordinate.slides; ++i) {
      const auto link = static_cast<std::size_t>(problem.links[i]);
      const double travel = std::abs(problem.chain.links[link].d_per_q);
      const double ratio = std::abs(problem.chain.links[link].theta_per_q);
      if (travel > 0) away = std::max(away, std::min(2 * far / travel, max_angle));
      // With a mimic joint whose ratio is not an integer, further turns differ from the first; for
      // a ratio in tenths the tenth turn is the first again.
      constexpr double turns = 10;
      if (!coordinate.periodic && travel == 0 && ratio > 0) {
        away = std::max(away, std::min(turns * half_turn / std::min(ratio, 1.0), max_angle));
      }
    }
    double lower = coordinate.lower, upper = coordinate.upper;
    if (!std::isfinite(lower)) lower = std::min(-away, upper - 2 * away);
    if (!std::isfinite(upper)) upper = std::max(away, lower + 2 * away);
    const double fraction = random.next();
    q[k] = ((1 - fraction) * lower + fraction * upper) * coordinate.unit;
  }
}

SeedTable seed_table(const NumericalProblem& problem, std::uint64_t random_seed, int blocks) {
  SeedTable seeds{blocks, random_seed, std::vector<EightNumbers>(12 * blocks)};
  const std::size_t dof = problem.coordinates.size();
  std::vector<EightNumbers> axes(6 * problem.links.size()), rows(dof);
  std::vector<double> q(dof);
  for (int b = 0; b < blocks; ++b) {
    for (int lane = 0; lane < solver_lane_count; ++lane) {
      draw_seed(problem, seeds, b, lane, q.data());
      for (std::size_t k = 0; k < dof; ++k) rows[k].lane[lane] = q[k] / problem.coordinates[k].unit;
    }
    HWY_DYNAMIC_DISPATCH(tools)
    (problem.chain, rows[0].lane, axes[0].lane, seeds.tool[12 * b].lane);
  }
  return seeds;
}

SeedTable SeedTable::make(const Arm&, const Key& key, const NumericalProblem& problem) {
  return seed_table(problem, key.random_seed);
}

void draw_seed(const NumericalProblem& problem, const SeedTable& seeds, int block, int lane,
               double* q) {
  Splitmix random(seeds.random_seed);
  random.skip((solver_lane_count * block + lane) * problem.coordinates.size());
  draw_configuration(problem, 1, random, q);
}

void nearest_seeds(const NumericalProblem& problem, const SeedTable& seeds,
                   const Pose& world_T_tool, int (&block)[solver_lane_count]) {
  const auto& rows = problem.task.rows;
  const bool base = problem.task.frame == Frame::base;
  const bool whole_place = rows[0] && rows[1] && rows[2],
             all_rotations = rows[3] && rows[4] && rows[5];
  double goal[12], weight[3], at[solver_lane_count];
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t i = 0; i < 3; ++i) goal[3 * column + i] = world_T_tool.data()[4 * column + i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    goal[9 + i] /= problem.length;
    weight[i] = whole_place || (base && rows[i]) ? 1 : 0;
  }
  HWY_DYNAMIC_DISPATCH(nearest)
  (seeds.tool[0].lane, seeds.blocks, goal, weight, all_rotations ? 1 : 0, at);
  for (int lane = 0; lane < solver_lane_count; ++lane) block[lane] = static_cast<int>(at[lane]);
}

}  // namespace internal
}  // namespace beeline

#endif
