// A control loop at 1 kHz: the tool of a Panda follows a figure of eight; prints the duration of
// the steps and the latency of the loop.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <numbers>
#include <thread>
#include <vector>

#include <beeline/control/servo.h>
#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

namespace {

using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

void print(const char* what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
  };
  std::cout << what << ", microseconds: median " << at(0.5) << ", 99.9 % below " << at(0.999)
            << ", worst " << values.back() << '\n';
}

/// Returns the commanded tool position at time t, relative to the centre of the eight: 20 cm wide,
/// 10 cm high, two seconds for each round after one second of acceleration.
beeline::Vector3 eight(double t) {
  const double phase = t < 1 ? t * t / 2 : t - 0.5;
  const double angle = std::numbers::pi * phase;
  return {0, 0.1 * std::sin(angle), 0.05 * std::sin(2 * angle)};
}

}  // namespace

int main() {
  constexpr double dt = 1e-3;
  constexpr int steps = 2500;
  const beeline::Arm panda = beeline::built_in("panda");
  beeline::Configuration q(7), velocity(7);
  q << 0, -0.785, 0, -2.356, 0, 1.571, 0.785;
  const beeline::Pose middle = forward_kinematics(panda, q);

  beeline::Servo servo(panda, {.time_step = dt});
  beeline::Trajectory trail = at_rest(panda, q);  // positions alone: linear between them
  trail.velocities.clear();
  trail.accelerations.clear();
  std::vector<double> took, late;
  double farthest = 0, min_scale = 1;
  Clock::time_point due = Clock::now();
  for (int i = 0; i < steps; ++i) {
    std::this_thread::sleep_until(due);
    const Clock::time_point begin = Clock::now();

    const double t = i * dt;
    beeline::Pose goal = middle;
    goal.translation() += eight(t);
    beeline::Twist command =
        10 * pose_error(goal, forward_kinematics(panda, q), beeline::Frame::base);
    command.head<3>() += (eight(t + dt) - eight(t)) / dt;
    const beeline::ServoStep step = servo.step(q, command, velocity);

    took.push_back(microseconds(Clock::now() - begin));
    late.push_back(microseconds(begin - due));
    due += std::chrono::milliseconds(1);
    q += dt * velocity;  // an ideal arm
    const beeline::Vector3 off = forward_kinematics(panda, q).translation() - middle.translation();
    farthest = std::max(farthest, (off - eight(t + dt)).norm());
    min_scale = std::min(min_scale, step.scale);
    if (i % 25 == 24) {
      trail.times.push_back(t + dt);
      trail.positions.push_back(q);
    }
  }
  print("duration of a step", took);
  print("latency", late);
  std::cout << "at most " << 1000 * farthest << " mm from the path, at least " << 100 * min_scale
            << " % of the commanded speed\n";
  save(motion_figure(panda, trail, {middle}), "07_servo.svg");
  return farthest < 1e-3 ? 0 : 1;
}
