// Times one step of the servo, anywhere and next to a singularity, and of the tracker. With a
// number of steps as argument also the slowest of them on a smooth random motion: bench_servo
// 10000000. Takes the options of Google Benchmark.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include <beeline/control/servo.h>
#include <beeline/control/tracker.h>
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

/// A control loop: the arm moves with the velocities of the servo.
struct Loop {
  explicit Loop(const char* name, double wrist)
      : arm(built_in(name)), servo(arm), q(middle_configuration(arm)), v(arm.dof()) {
    if (wrist > 0) q[arm.dof() == 6 ? 4 : 5] = wrist;
    q[1] += 0.2, q[2] += 0.5, q[3] += 0.3;
    home = forward_kinematics(arm, q);
  }
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

/// Prints the slowest of `count` steps: as measured in the first pass, with all interruptions, and
/// by the faster of two equal passes of each step, which is the time of the step itself.
void print_slowest(const char* name, long count) {
  const double cost = clock_cost();
  std::vector<float> times(static_cast<std::size_t>(count), 1e30F);
  float first = 0;
  for (int pass = 0; pass < 2; ++pass) {
    Loop loop(name, 0);
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
  std::printf(
      "%s, %ld steps, microseconds: median %.2f, 99.9 %% %.2f, 99.9999 %% %.2f, worst %.2f; "
      "worst of a single pass %.0f\n",
      name, count, at(0.5), at(0.999), at(0.999999), times.back(), first);
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
    for (const char* name : {"ur5", "panda"}) print_slowest(name, count);
    return 0;
  }
  for (const char* name : {"puma560", "ur5", "panda", "iiwa14"}) {
    add(name);
    add_tracker(name);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
