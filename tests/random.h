#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>

#include <beeline/model/arm.h>

namespace beeline::testing {

/// Sanitizers take up to 100 times as long, the emulator about 20 times.
#if defined(BEELINE_SANITIZED) || defined(BEELINE_EMULATED)
constexpr bool slow_build = true;
#else
constexpr bool slow_build = false;
#endif

/// The number of random cases, or of cancellations, of a test that takes long and has `n` of them
/// in a thorough run (`make test CASES=3`): n / 3, under a sanitizer or an emulator n / 10, times
/// the environment variable BEELINE_CASES, at least one. Sanitizers look for invalid operations,
/// which few cases show as well as many.
inline int cases(int n) {
  const char* text = std::getenv("BEELINE_CASES");
  const double factor = text == nullptr || *text == '\0' ? 1 : std::stod(text);
  return std::max(1, static_cast<int>(n * factor / (slow_build ? 10 : 3)));
}

/// The size of a large example: n, under a sanitizer or an emulator n / 10.
constexpr int example_size(int n) { return slow_build ? n / 10 : n; }

/// Random cases with a printed seed: BEELINE_SEED=... repeats a run.
class Random {
 public:
  Random() : Random(seed_from_environment()) {}
  explicit Random(std::uint64_t seed) : engine_(seed) {
    std::cout << "[   seed   ] BEELINE_SEED=" << seed << '\n';
  }

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  int integer(int lower, int upper) {
    return std::uniform_int_distribution<int>(lower, upper)(engine_);
  }

  Vector3 vector(double size = 1) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }

  Vector3 direction() {
    std::normal_distribution<double> normal;
    Vector3 v;
    do {
      v = {normal(engine_), normal(engine_), normal(engine_)};
    } while (v.norm() < 1e-6);
    return v.normalized();
  }

  /// A rotation about a random axis by up to `angle`.
  Rotation rotation(double angle = 3.14159265358979) {
    return so3_exp(direction() * uniform(0, angle));
  }

  Pose pose(double size = 1) {
    Pose pose = Pose::Identity();
    pose.linear() = rotation();
    pose.translation() = vector(size);
    return pose;
  }

  /// random_configuration().
  Configuration configuration(const Arm& arm) { return random_configuration(arm, engine_); }

 private:
  static std::uint64_t seed_from_environment() {
    const char* text = std::getenv("BEELINE_SEED");
    return text == nullptr ? 20240229 : std::stoull(text);
  }
  std::mt19937_64 engine_;
};

}  // namespace beeline::testing
