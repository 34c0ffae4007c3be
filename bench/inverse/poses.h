#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <vector>

#include "screws.h"

namespace beeline::bench {

/// What is asked of one arm: random configurations within limits, the tool's poses there, and for
/// tracking a seed of which no value is more than 0.1 away (radians, metres), within limits too.
struct Poses {
  std::vector<Configuration> q;
  std::vector<Configuration> near;
  std::vector<Pose> world_T_tool;
};

using Engine = std::mt19937_64;

double uniform(Engine& engine, double lower, double upper);

/// Uniform within the limits, the last joint where it is given.
Configuration random_configuration(const Screws& screws, Engine& engine);

/// The same seed gives the same poses.
Poses random_poses(const Screws& screws, int count, std::uint64_t seed);

/// The middle of the limits.
Configuration middle(const Screws& screws);

/// For the peers that are no C++: arm.json (axes, points, limits, home), and pose.f64, q.f64 and
/// near.f64, rows of doubles (a pose is its 4 x 4 matrix, row by row).
void write_poses(const std::filesystem::path& folder, const BenchArm& arm, const Screws& screws,
                 const Poses& poses);

}  // namespace beeline::bench
