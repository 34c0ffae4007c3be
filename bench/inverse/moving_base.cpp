// Measures inverse kinematics and straight lines of arms on rails and mobile bases: the tables of
// docs/howto/rail.md.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <numbers>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/moving_base.h>
#include <beeline/planning/move_along.h>
#include <beeline/pose/se3.h>

#include "poses.h"
#include "timing.h"

namespace beeline::bench {
namespace {

double middle(std::vector<double> times) {
  const auto half = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), half, times.end());
  return *half;
}

/// Prints the solutions found without a seed, and the median times of a call without one, and of
/// one from a seed that is off by up to 5 % of each joint's range.
void measure_solutions(const char* what, const Arm& arm, int count) {
  Engine engine(1);
  std::vector<double> without, with;
  int found = 0;
  std::string method;
  for (int i = 0; i < count; ++i) {
    const Configuration q = random_configuration(arm, engine);
    const Pose pose = forward_kinematics(arm, q);
    InverseOptions options;
    auto start = std::chrono::steady_clock::now();
    const InverseResult result = inverse_kinematics(arm, pose, options);
    without.push_back(microseconds_since(start));
    if (result.status == InverseStatus::solved) ++found;
    method = result.method;
    options.seed = q + 0.05 * (random_configuration(arm, engine) - q);
    start = std::chrono::steady_clock::now();
    inverse_kinematics(arm, pose, options);
    with.push_back(microseconds_since(start));
  }
  std::printf("| %s | %d | %s | %d | %.1f µs | %.1f µs |\n", what, arm.dof(), method.c_str(), found,
              middle(without), middle(with));
}

/// The box of a line's ends in x and y, m.
struct Floor {
  double x_min, x_max, y_min, y_max;
};

/// Prints the lines that are reached, between poses with the tool straight down and turned by up to
/// 45 degrees about the vertical axis, and the median time of planning, timing and proof.
void measure_lines(const char* what, const Arm& arm, const Floor& floor, int count) {
  Engine engine(1);
  constexpr double turn = std::numbers::pi / 4;
  const Rotation down = Eigen::AngleAxisd(std::numbers::pi, Vector3::UnitX()).toRotationMatrix();
  const auto pose = [&] {
    const double x = uniform(engine, floor.x_min, floor.x_max);
    const double y = uniform(engine, floor.y_min, floor.y_max);
    const double z = uniform(engine, 0.1, 0.5);
    const Eigen::AngleAxisd about(uniform(engine, -turn, turn), Vector3::UnitZ());
    return make_pose({x, y, z}, about.toRotationMatrix() * down);
  };
  std::vector<double> times;
  double length = 0;
  int reached = 0;
  for (int i = 0; i < count; ++i) {
    const std::vector<Pose> ends{pose(), pose()};
    length += (ends[1].translation() - ends[0].translation()).norm();
    const auto start = std::chrono::steady_clock::now();
    const auto motion = move_in_lines(arm, std::span<const Pose>(ends));
    times.push_back(microseconds_since(start) / 1000);
    if (motion.status == MotionStatus::reached) ++reached;
  }
  std::printf("| %s | %.2f m | %d of %d | %.0f ms |\n", what, length / count, reached, count,
              middle(times));
}

int run(int argc, char** argv) {
  int poses = 10000, lines = 200;
  CLI::App app("Arms on rails and mobile bases");
  app.add_option("--poses", poses, "Poses of each arm")->check(CLI::Range(1, 10000000));
  app.add_option("--lines", lines, "Lines of each arm")->check(CLI::Range(1, 1000000));
  CLI11_PARSE(app, argc, argv);
  stay_on_one_core();
  const Arm ur5 = built_in("ur5"), panda = built_in("panda");
  const Vector3 x = Vector3::UnitX();
  const Limits four{.lower = -2, .upper = 2}, two{.lower = 0, .upper = 2};
  const MobileBase base{.x = four, .y = four};
  std::printf(
      "| arm | joints | method | found | without a seed | from a seed "
      "|\n|---|---|---|---|---|---|\n");
  measure_solutions("ur5", ur5, poses);
  measure_solutions("ur5 on a rail", with_rail(ur5, x, two), poses);
  measure_solutions("panda", panda, poses);
  measure_solutions("panda on a rail", with_rail(panda, x, two), poses);
  measure_solutions("ur5 on a mobile base", with_mobile_base(ur5, base), poses);
  measure_solutions("panda on a mobile base", with_mobile_base(panda, base), poses);
  const Limits three{.lower = 0, .upper = 3};
  const Floor along{0.3, 3, 0.3, 0.6}, all{-2, 2, -2, 2};
  std::printf("\n| arm | mean length | reached | time |\n|---|---|---|---|\n");
  measure_lines("ur5", ur5, {0.3, 0.6, 0.2, 0.5}, lines);
  measure_lines("ur5 on a rail of 3 m", with_rail(ur5, x, three), along, lines);
  measure_lines("panda", panda, {0.3, 0.6, 0.2, 0.4}, lines);
  measure_lines("panda on a rail of 3 m", with_rail(panda, x, three), along, lines);
  measure_lines("ur5 on a base of 4 m by 4 m", with_mobile_base(ur5, base), all, lines);
  measure_lines("panda on a base of 4 m by 4 m", with_mobile_base(panda, base), all, lines);
  return 0;
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  try {
    return beeline::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_moving_base: %s\n", error.what());
    return 2;
  }
}
