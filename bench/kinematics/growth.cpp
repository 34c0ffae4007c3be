// Prints the cost of forward kinematics over the number of joints and of configurations.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include <beeline/batch/batch.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include "../inverse/poses.h"
#include "../inverse/timing.h"

namespace beeline::bench {
namespace {

/// Returns a chain of revolute joints about random axes, 2 m long.
Arm snake(int joints, Engine& engine) {
  std::vector<Joint> chain;
  for (int i = 0; i < joints; ++i) {
    Joint joint;
    joint.name = "joint" + std::to_string(i + 1);
    joint.screw = rotation_screw({uniform(engine, -1, 1), uniform(engine, -1, 1), 1});
    joint.offset = make_pose({0, 0, 2.0 / joints});
    chain.push_back(joint);
  }
  return {"snake", chain};
}

/// Returns the median of a few runs, microseconds.
template <class Call>
double median_time(const Call& call) {
  std::vector<double> times;
  for (int pass = 0; pass < 7; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    call();
    times.push_back(microseconds_since(start));
  }
  std::nth_element(times.begin(), times.begin() + 3, times.end());
  return times[3];
}

void by_joints(Engine& engine) {
  std::printf("| joints | ns a call | a joint | batch, ns a configuration |\n|---|---|---|---|\n");
  for (const int joints : {2, 4, 8, 16, 32, 64, 100}) {
    const Arm arm = snake(joints, engine);
    const int count = 200'000 / joints;
    Eigen::MatrixXd q = Eigen::MatrixXd::Random(joints, count), poses(16, count);
    double sum = 0;
    const double calls = median_time([&] {
      for (int i = 0; i < count; ++i) sum += forward_kinematics(arm, q.col(i))(0, 3);
    });
    const double batch = median_time([&] { batch_forward<double>(arm, q, poses, {.threads = 1}); });
    const double each = 1000 * calls / count;
    std::printf("| %d | %.1f | %.2f | %.1f |\n", joints, each, each / joints, 1000 * batch / count);
    if (sum == 0.123) std::printf("\n");  // keeps the compiler from removing the work
  }
}

void by_configurations() {
  const Arm arm = built_in("panda");
  std::printf("| configurations | µs | ns a configuration |\n|---|---|---|\n");
  for (const Eigen::Index count : {1, 10, 100, 1000, 10'000, 100'000, 1'000'000, 10'000'000}) {
    Eigen::MatrixXd q = Eigen::MatrixXd::Random(arm.dof(), count), poses(7, count);
    const BatchOptions options{.layout = PoseLayout::position_quaternion, .threads = 1};
    const int repeats = static_cast<int>(std::max<Eigen::Index>(1, 100'000 / count));
    const double time = median_time([&] {
      for (int i = 0; i < repeats; ++i) batch_forward<double>(arm, q, poses, options);
    });
    const double each = 1000 * time / repeats / static_cast<double>(count);
    std::printf("| %ld | %.3f | %.2f |\n", static_cast<long>(count), time / repeats, each);
  }
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  CLI::App app("Times forward kinematics by the number of joints, or of configurations");
  std::string by = "joints";
  app.add_option("by", by, "joints or configurations")
      ->check(CLI::IsMember({"joints", "configurations"}));
  CLI11_PARSE(app, argc, argv);
  try {
    stay_on_one_core();
    Engine engine(20240503);
    if (by == "joints") by_joints(engine);
    if (by == "configurations") by_configurations();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_kinematics_growth: %s\n", error.what());
    return 2;
  }
  return 0;
}
