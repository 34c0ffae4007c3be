// Times one step of the servo, anywhere and next to a singularity, and of the tracker. With a
// number of steps as argument the slowest of them on a smooth random motion, without obstacles and
// among 20 of them: bench_servo 10000000. Takes the options of Google Benchmark.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <beeline/collision/collision_model.h>
#include <beeline/control/servo.h>
#include <beeline/control/tracker.h>
#include <beeline/io/text/scene.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include "../inverse/timing.h"

#include <benchmark/benchmark.h>

namespace beeline::bench {
namespace {

constexpr double dt = 1e-3;

/// The commanded tool motion: sums of sines with incommensurable periods.
Twist command_at(double t) {
  Twist command;
  for (int i = 0; i < 6; ++i) {
    const double size = i < 3 ? 0.15 : 0.4;
    command[i] = size * (std::sin((0.61 + 0.17 * i) * t + i) + std::sin((1.37 + 0.11 * i) * t));
  }
  return command;
}

/// The configuration at which a loop begins.
Configuration start_of(const Arm& arm, double wrist) {
  Configuration q = middle_configuration(arm);
  if (wrist > 0) q[arm.dof() == 6 ? 4 : 5] = wrist;
  q[1] += 0.2, q[2] += 0.5, q[3] += 0.3;
  return q;
}

/// The arm among obstacles around its tool: boxes, cylinders and spheres of 4 to 12 cm, which keep
/// 4 cm from the arm at the start.
CollisionModel cell_of(const char* name, std::size_t count) {
  const Arm arm = built_in(name);
  const ArmShapes shapes = read_arm_shapes(name);
  const Configuration start = start_of(arm, 0);
  const Vector3 tool = forward_kinematics(arm, start).translation();
  std::mt19937_64 engine(1);
  const auto uniform = [&engine](double from, double to) {
    return from + (to - from) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  Scene scene;
  while (scene.obstacles.size() < count) {
    const double size = uniform(0.04, 0.12);
    const std::size_t kind = scene.obstacles.size() % 3;
    const Vector3 at = tool + Vector3(uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-0.5, 0.5));
    const Pose pose = make_pose(at, so3_exp(Vector3(uniform(-3, 3), uniform(-3, 3), 0)));
    Obstacle obstacle{.name = "obstacle " + std::to_string(scene.obstacles.size() + 1),
                      .clearance = 0.01};
    if (kind == 0) obstacle.shapes = {{Box{Vector3::Constant(size)}, pose}};
    if (kind == 1) obstacle.shapes = {{Cylinder{size / 2, size}, pose}};
    if (kind == 2) obstacle.shapes = {{Sphere{size / 2}, pose}};
    const Scene alone{.obstacles = {obstacle}};
    const CollisionModel one(arm, shapes.links, alone, {.self_collision = false});
    if (nearest_pair(one, start).lower > 0.04) scene.obstacles.push_back(std::move(obstacle));
  }
  return CollisionModel(arm, shapes.links, scene, {.allowed_pairs = shapes.allowed_pairs});
}

/// A control loop: the arm moves with the velocities of the servo.
struct Loop {
  explicit Loop(const char* name, double wrist, const CollisionModel* model = nullptr)
      : arm(built_in(name)),
        servo(arm, {.model = model}),
        q(start_of(arm, wrist)),
        home(forward_kinematics(arm, q)),
        v(arm.dof()) {}
  /// Stays near the start configuration.
  Twist command(double t) const {
    return command_at(t) + 0.5 * pose_error(home, forward_kinematics(arm, q), Frame::base);
  }
  Arm arm;
  Servo servo;
  Configuration q;
  Pose home;
  Eigen::VectorXd v;
};

void add(const char* name) {
  benchmark::RegisterBenchmark((std::string(name) + "/regular").c_str(), [name](auto& state) {
    Loop loop(name, 0);
    double t = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(loop.servo.step(loop.q, command_at(t += dt), loop.v));
      if (t < 0.5) loop.q += dt * loop.v;  // then stays in place
    }
  });
  for (const double wrist : {1e-3, 1e-8}) {
    const std::string near = wrist > 1e-4 ? "/wrist at 1e-3 rad" : "/wrist at 1e-8 rad";
    benchmark::RegisterBenchmark((name + near).c_str(), [name, wrist](auto& state) {
      Loop loop(name, wrist);
      double t = 0;
      for (auto _ : state) {
        benchmark::DoNotOptimize(loop.servo.step(loop.q, command_at(t += dt), loop.v));
      }
    });
  }
}

/// The tracker follows a smooth motion within the limits.
void add_tracker(const char* name) {
  benchmark::RegisterBenchmark((std::string(name) + "/tracker").c_str(), [name](auto& state) {
    const Loop loop(name, 0);
    std::vector<Pose> commands;
    for (int i = 0; i < 20000; ++i) {
      const double angle = 1e-4 * std::numbers::pi * i;
      Pose pose = loop.home;
      pose.translation() +=
          0.03 * Vector3(std::cos(angle) - 1, std::sin(angle) * std::sin(angle), 0);
      commands.push_back(pose);
    }
    Tracker tracker(loop.arm, loop.q);
    std::size_t i = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(&tracker.step(commands[i++ % commands.size()]));
    }
  });
}

/// Prints the slowest of `count` steps, with a number of obstacles or without a model: as measured
/// in the first pass, with all interruptions, and by the faster of two equal passes of each step,
/// which is the time of the step itself.
void print_slowest(const char* name, long count, const std::optional<std::size_t>& obstacles) {
  const double cost = clock_cost();
  std::optional<CollisionModel> model;
  if (obstacles) model.emplace(cell_of(name, *obstacles));
  std::vector<float> times(static_cast<std::size_t>(count), 1e30F);
  float first = 0;
  for (int pass = 0; pass < 2; ++pass) {
    Loop loop(name, 0, model ? &*model : nullptr);
    for (long i = 0; i < count; ++i) {
      const Twist command = loop.command(dt * static_cast<double>(i));
      const auto start = std::chrono::steady_clock::now();
      loop.servo.step(loop.q, command, loop.v);
      const auto took = static_cast<float>(microseconds_since(start) - cost);
      loop.q += dt * loop.v;
      if (pass == 0) first = std::max(first, took);
      float& best = times[i];
      best = std::min(best, took);
    }
  }
  std::sort(times.begin(), times.end());
  const auto at = [&](double part) {
    return times[static_cast<std::size_t>(part * static_cast<double>(times.size() - 1))];
  };
  const std::string cell =
      obstacles ? " among " + std::to_string(*obstacles) + " obstacles and itself" : "";
  std::printf(
      "%s%s, %ld steps, microseconds: median %.2f, 99.9 %% %.2f, 99.9999 %% %.2f, worst %.2f; "
      "worst of a single pass %.0f\n",
      name, cell.c_str(), count, at(0.5), at(0.999), at(0.999999), times.back(), first);
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  benchmark::Initialize(&argc, argv);
  stay_on_one_core();
  if (argc > 1) {
    const long count = std::atol(argv[1]);
    if (argc > 2 || count < 1) {
      std::fprintf(stderr, "usage: bench_servo [steps]\n");
      return 2;
    }
    for (const char* name : {"ur5", "panda"}) print_slowest(name, count, std::nullopt);
    for (const char* name : {"ur5", "panda"}) print_slowest(name, count, 20);
    return 0;
  }
  for (const char* name : {"puma560", "ur5", "panda", "iiwa14"}) {
    add(name);
    add_tracker(name);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
