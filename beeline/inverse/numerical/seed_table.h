#pragma once

#include <cstdint>

#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>

namespace beeline::internal {

/// SplitMix64 (Steele, Lea & Flood 2014): the same numbers on every machine, and free to start.
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

/// A random configuration within the bounds, radians and metres, dof numbers into q. Where there
/// is no bound: one turn for an angle, `far` units of length each way for a slide, and for a screw
/// as many turns as take it that far.
void draw_configuration(const NumericalProblem& problem, double far, Splitmix& random, double* q);

/// Random configurations and where they bring the tool, made once for many poses: descents from
/// those that come nearest to a pose need fewer steps to it, and arrive more often.
struct SeedTable {
  int blocks = 0;                  ///< of eight configurations
  std::vector<EightNumbers> q;     ///< block by block, a row for each coordinate
  std::vector<EightNumbers> tool;  ///< block by block: columns x, y, z and origin, 12 rows
};
SeedTable seed_table(const NumericalProblem& problem, std::uint64_t random_seed, int blocks = 64);

/// For each of eight, which block's has its tool nearest to the pose, in what the task asks for.
void nearest_seeds(const NumericalProblem& problem, const SeedTable& seeds,
                   const Pose& world_T_tool, int (&block)[solver_lane_count]);

}  // namespace beeline::internal
