// Teleoperation at 1 kHz: a UR5e follows poses that a hand controller sends 90 times a second. The
// hand trembles, jumps once and reaches too far; prints how well and how smoothly the arm follows.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include <beeline/control/tracker.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

namespace {

constexpr double dt = 1e-3;

/// Returns the pose that the hand commands at time t: circles of 10 cm, a jump of 20 cm after 4 s,
/// half a metre further out from 6 to 8 s.
beeline::Pose hand(const beeline::Pose& start, double t) {
  const double tremor = 2e-4 * std::sin(2 * std::numbers::pi * 9 * t);
  beeline::Pose pose = start;
  pose.translation() += beeline::Vector3(0.05 * std::sin(2 * t), 0.05 * std::cos(2 * t), tremor);
  if (t > 4) pose.translation().z() += 0.2;
  if (t > 6 && t < 8) pose.translation() *= 1.8;
  return pose;
}

}  // namespace

int main() {
  const beeline::Arm arm = beeline::built_in("ur5e");
  const beeline::Configuration home{{0.3, -1.2, 1.6, -0.8, -1.2, 0.2}};
  const beeline::Pose start = forward_kinematics(arm, home);

  beeline::Tracker tracker(arm, home, {.time_step = dt, .command_period = 1.0 / 90});
  std::array<int, 4> count{};  // steps of each status
  beeline::Pose command = start;
  double next_command = 0, fastest = 0, error = 0;
  for (double t = 0; t < 12; t += dt) {
    if (t >= next_command) {
      command = hand(start, t);
      next_command += 1.0 / 90;
    }
    const beeline::TrackerStep& step = tracker.step(command);  // send step.q to the arm
    ++count[static_cast<std::size_t>(step.status)];
    fastest = std::max(fastest, step.velocity.lpNorm<Eigen::Infinity>());
    if (t > 10) error = std::max(error, step.error.position);
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    std::cout << name(static_cast<beeline::TrackerStatus>(i)) << ": " << count[i] << " ms\n";
  }
  std::cout << "fastest joint " << fastest << " rad/s, error after the jumps at most "
            << 1e6 * error << " micrometres\n";
  return error < 1e-4 ? 0 : 1;
}
