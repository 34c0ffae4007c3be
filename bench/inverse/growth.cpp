// Measures the cost of one iteration of the numerical solver on chains of 6 to 100 joints.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/se3.h>

#include "poses.h"
#include "timing.h"

namespace beeline::bench {
namespace {

/// Revolute joints about random axes, 2 m in all, each within +-1.5 rad.
Arm snake(int joints, Engine& engine) {
  std::vector<Joint> chain;
  for (int i = 0; i < joints; ++i) {
    Vector3 axis(uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1));
    Joint joint;
    joint.name = "joint" + std::to_string(i + 1);
    joint.screw = rotation_screw(axis);
    joint.offset = make_pose({0, 0, 2.0 / joints});
    joint.limits = {.lower = -1.5, .upper = 1.5};
    chain.push_back(joint);
  }
  return {"snake", chain, make_pose({0, 0, 2.0 / joints})};
}

void measure(int joints, int count, Engine& engine) {
  const Arm arm = snake(joints, engine);
  std::vector<Pose> poses;
  std::vector<Configuration> seeds;
  for (int n = 0; n < count; ++n) {
    Configuration q(joints), near(joints);
    for (int i = 0; i < joints; ++i) {
      q[i] = uniform(engine, -1.2, 1.2);
      near[i] = q[i] + uniform(engine, -0.3, 0.3);
    }
    poses.push_back(forward_kinematics(arm, q));
    seeds.push_back(near);
  }
  InverseOptions options{.method = InverseMethod::numerical};
  long iterations = 0, solved = 0;
  std::vector<double> times;
  for (int pass = 0; pass < 7; ++pass) {
    iterations = solved = 0;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t n = 0; n < poses.size(); ++n) {
      options.seed = seeds[n];
      const InverseResult result = inverse_kinematics(arm, poses[n], options);
      iterations += result.iterations;
      solved += result.status == InverseStatus::solved ? 1 : 0;
    }
    times.push_back(microseconds_since(start));
  }
  std::nth_element(times.begin(), times.begin() + 3, times.end());
  const double each = times[3] / static_cast<double>(std::max(1L, iterations));
  std::printf("| %d | %.2f %% | %.2f | %.3f | %.4f |\n", joints,
              100.0 * static_cast<double>(solved) / count, static_cast<double>(iterations) / count,
              each, each / joints);
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  CLI::App app("Times an iteration of the numerical solver on chains of 6 to 100 joints");
  int count = 1000;
  std::uint64_t seed = 20240303;
  app.add_option("--count", count, "poses a chain")->capture_default_str();
  app.add_option("--random-seed", seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    stay_on_one_core();
    std::printf(
        "Random seed %llu\n\n| joints | solved | iterations a pose | µs an iteration | a "
        "joint |\n|---|---|---|---|---|\n",
        static_cast<unsigned long long>(seed));
    Engine engine(seed);
    for (const int joints : {6, 7, 10, 15, 20, 30, 50, 70, 100}) measure(joints, count, engine);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_inverse_growth: %s\n", error.what());
    return 2;
  }
  return 0;
}
