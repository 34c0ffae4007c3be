#pragma once

#include <cstdint>

#include <beeline/inverse/numerical/numerical_problem.h>

namespace beeline::internal {

/// SplitMix64 (Steele, Lea & Flood 2014): the same numbers on every machine, and no state to set
/// up.
class Splitmix {
 public:
  explicit Splitmix(std::uint64_t seed) : state_(seed) {}

  /// Uniform in [0, 1).
  double next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// Draws a configuration uniformly within the bounds, radians and metres, into the dof numbers at
/// q. Where a coordinate has no bound: one turn for an angle, `far` units of length each way for a
/// prismatic joint, and as many turns as travel that far for a helical joint.
void draw_configuration(const NumericalProblem& problem, double far, Splitmix& random, double* q);

/// Random configurations and their tool poses, made once for many goals: the solver needs fewer
/// steps from those whose tool is nearest to the goal, and converges more often.
struct SeedTable {
  int blocks = 0;                  ///< of eight configurations
  std::vector<EightNumbers> q;     ///< block by block, one for each coordinate
  std::vector<EightNumbers> tool;  ///< block by block: columns x, y, z and origin, 12 rows
};
/// More blocks save steps of the solver, but every search reads the whole table.
SeedTable seed_table(const NumericalProblem& problem, std::uint64_t random_seed, int blocks = 64);

/// Finds, for each of the eight lanes, the block whose tool is nearest to the pose, in the
/// components of the task.
void nearest_seeds(const NumericalProblem& problem, const SeedTable& seeds,
                   const Pose& world_T_tool, int (&block)[solver_lane_count]);

}  // namespace beeline::internal
