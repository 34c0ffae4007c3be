#pragma once

#include <random>

#include <beeline/pose/se3.h>

namespace beeline::bench {

using Engine = std::mt19937_64;

inline double uniform(Engine& engine, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(engine);
}

/// A unit vector.
inline Vector3 direction(Engine& engine) {
  std::normal_distribution<double> normal;
  return Vector3(normal(engine), normal(engine), normal(engine)).normalized();
}

}  // namespace beeline::bench
