#pragma once

#include <cstdint>

#include <beeline/inverse/numerical/numerical_problem.h>

namespace beeline::internal {

/// The pseudorandom number generator SplitMix64 (Steele, Lea & Flood 2014). It gives the same
/// numbers on every machine.
class Splitmix {
 public:
  explicit Splitmix(std::uint64_t seed) : state_(seed) {}

  void skip(std::uint64_t numbers) { state_ += numbers * step; }

  /// Uniform in [0, 1).
  double next() {
    std::uint64_t z = state_ += step;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15;

  std::uint64_t state_;
};

/// Draws a configuration uniformly within the bounds, radians and metres, into the dof numbers at
/// q. A coordinate without bounds is drawn from one revolution for an angle, from `far` units of
/// length to both sides for a prismatic joint, and from the revolutions with that travel for a
/// helical joint.
void draw_configuration(const NumericalProblem& problem, double far, Splitmix& random, double* q);

/// The tool poses of random configurations, computed once for many goals. From the configurations
/// whose tool is nearest to the goal, the solver needs fewer steps and converges more often.
struct SeedTable {
  int blocks = 0;                  ///< number of blocks of eight configurations
  std::uint64_t random_seed = 1;   ///< seed of the configurations, see draw_seed()
  std::vector<EightNumbers> tool;  ///< block by block: columns x, y, z and origin, 12 rows

  // As an arm keeps it: see Kept. The task of the problem makes no difference.
  struct Key {
    bool ignore_limits = false;
    std::uint64_t random_seed = 1;
    bool operator==(const Key&) const = default;
  };
  static constexpr SharedBy shared_by = SharedBy::copies;
  static SeedTable make(const Arm& arm, const Key& key, const NumericalProblem& problem);
  std::size_t heap_bytes() const { return internal::heap_bytes(tool); }
};
/// Returns a table of `blocks` times eight seeds. More blocks reduce the solver's steps, but every
/// search reads the whole table.
SeedTable seed_table(const NumericalProblem& problem, std::uint64_t random_seed, int blocks = 64);

/// Draws the configuration of a block and lane again, into the dof numbers at q.
void draw_seed(const NumericalProblem& problem, const SeedTable& seeds, int block, int lane,
               double* q);

/// Finds, for each of the eight lanes, the block whose tool is nearest to the pose, in the
/// components of the task.
void nearest_seeds(const NumericalProblem& problem, const SeedTable& seeds,
                   const Pose& world_T_tool, int (&block)[solver_lane_count]);

}  // namespace beeline::internal
