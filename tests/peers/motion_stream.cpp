// Usage: motion_stream JOINTS < motions > answers
//
// Beeline's motions from rest to rest for another implementation to be compared with. Both streams
// are doubles in the machine's own order. Read, for each motion: velocity limits, acceleration
// limits, jerk limits, from, to, each a number a joint. Written: the durations synchronised by time
// and in a straight line; how long each joint would need alone; then at the tenths of the first
// duration, 1/10 to 9/10, the joints' positions, velocities and accelerations.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include <beeline/timing/point_to_point.h>

namespace {

using beeline::Configuration;

void write(const Configuration& numbers) {
  std::fwrite(numbers.data(), sizeof(double), static_cast<std::size_t>(numbers.size()), stdout);
}

void answer(const Eigen::MatrixXd& asked) {
  const Eigen::Index joints = asked.rows();
  std::vector<beeline::Limits> limits;
  Configuration alone(joints);
  for (Eigen::Index k = 0; k < joints; ++k) {
    limits.push_back({.velocity = asked(k, 0), .acceleration = asked(k, 1), .jerk = asked(k, 2)});
    alone[k] = beeline::s_curve(asked(k, 4) - asked(k, 3), limits.back()).duration;
  }
  beeline::PointToPoint motion, straight;
  beeline::point_to_point(limits, asked.col(3), asked.col(4), motion);
  beeline::point_to_point(limits, asked.col(3), asked.col(4), straight,
                          {beeline::Synchronise::straight});
  write(Eigen::Vector2d(motion.duration, straight.duration));
  write(alone);
  for (int tenth = 1; tenth < 10; ++tenth) {
    Configuration q(joints), v(joints), a(joints);
    beeline::at(motion, motion.duration * tenth / 10, q, v, a);
    for (const Configuration& numbers : {q, v, a}) write(numbers);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int joints = argc == 2 ? std::atoi(argv[1]) : 0;
  if (joints < 1) {
    std::fprintf(stderr, "usage: motion_stream JOINTS\n");
    return 2;
  }
  try {
    Eigen::MatrixXd asked(joints, 5);
    const auto size = static_cast<std::size_t>(asked.size());
    while (std::fread(asked.data(), sizeof(double), size, stdin) == size) answer(asked);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
