#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <vector>

#include "screws.h"

namespace beeline::bench {

/// The problems of one arm: random configurations within limits, their tool poses, and for tracking
/// a seed within limits whose values differ by at most 0.1 (radians, metres).
struct Poses {
  std::vector<Configuration> q;
  std::vector<Configuration> near;
  std::vector<Pose> world_T_tool;
};

using Engine = std::mt19937_64;

double uniform(Engine& engine, double lower, double upper);

/// Returns a configuration uniform within the limits, with a locked last joint at its value.
Configuration random_configuration(const Screws& screws, Engine& engine);

/// The same seed gives the same poses.
Poses random_poses(const Screws& screws, int count, std::uint64_t seed);

/// Returns the middle of the limits.
Configuration middle(const Screws& screws);

/// Writes the files for the Python peers: arm.json (axes, points, limits, home), and pose.f64,
/// q.f64 and near.f64, rows of doubles (a pose is its 4 x 4 matrix, row by row).
void write_poses(const std::filesystem::path& folder, const BenchArm& arm, const Screws& screws,
                 const Poses& poses);

}  // namespace beeline::bench
