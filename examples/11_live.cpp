// A running program, live: a UR5 follows a circle, and posts its joint values 60 times a second to
// the page that `beeline view ur5` shows. Without that command only the picture is made.
// Usage: 11_live [http://127.0.0.1:8642]
#include <chrono>
#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>

#include <beeline/control/servo.h>
#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <httplib.h>

namespace {

constexpr int rate = 60;  // Hz, as screens show it

std::string json(const beeline::Configuration& q) {
  std::ostringstream text;
  text.precision(17);
  text << q.transpose().format({Eigen::FullPrecision, Eigen::DontAlignCols, ", "});
  return "{\"q\": [" + text.str() + "]}";
}

}  // namespace

int main(int argc, char** argv) {
  const std::string given = argc > 1 ? argv[1] : "";
  const std::string address = given.starts_with("http") ? given : "http://127.0.0.1:8642";
  httplib::Client server(address);
  server.set_keep_alive(true);
  const bool connected = static_cast<bool>(server.Get("/api/session"));
  if (!connected) {
    std::cout << "Nothing listens at " << address
              << ": start `beeline view ur5`, then run this again\n";
  }

  const beeline::Arm ur5 = beeline::built_in("ur5");
  beeline::Configuration q(6), velocity(6);
  q << 0.4, -1.2, 1.6, -1.9, -1.5, 0;
  const beeline::Pose centre = forward_kinematics(ur5, q);
  beeline::Servo servo(ur5, {.time_step = 1.0 / rate});
  beeline::Trajectory trail = at_rest(ur5, q);  // positions alone: linear between them
  trail.velocities.clear();
  trail.accelerations.clear();
  auto due = std::chrono::steady_clock::now();
  for (int i = 1; i <= 5 * rate; ++i) {
    const double t = static_cast<double>(i) / rate;
    beeline::Pose goal = centre;
    goal.translation() += 0.1 * beeline::Vector3(0, std::sin(2 * t), 1 - std::cos(2 * t));
    servo.step(q, 10 * pose_error(goal, forward_kinematics(ur5, q), beeline::Frame::base),
               velocity);
    q += velocity / rate;  // your robot or simulation
    trail.times.push_back(t);
    trail.positions.push_back(q);
    if (!connected) continue;
    const httplib::Result answer = server.Post("/api/joints", json(q), "application/json");
    if (!answer || answer->status != 204) {
      std::cerr << (answer ? answer->body : to_string(answer.error())) << '\n';
      return 1;
    }
    due += std::chrono::microseconds(1000000 / rate);
    std::this_thread::sleep_until(due);
  }
  save(motion_figure(ur5, trail), "11_live.svg");
  return 0;
}
