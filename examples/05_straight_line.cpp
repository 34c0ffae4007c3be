// The tool moves in straight lines through waypoints; prints the measured and the proved deviation.
#include <iostream>
#include <numbers>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : ".";  // with the waypoints
  const auto degrees = beeline::AngleUnit::degrees;
  const auto poses =
      beeline::read_poses(folder + "/waypoints_rrr.csv", {.angle_unit = degrees}).poses;

  const beeline::Arm rrr = beeline::built_in("rrr");
  const Eigen::Vector3d start(0, std::numbers::pi / 2, 0);
  const beeline::PathMotion motion = move_in_lines(rrr, start, poses);
  if (motion.status != beeline::MotionStatus::reached) {
    std::cout << name(motion.status) << ": " << motion.reason << '\n';
    return 1;
  }
  std::cout << motion.trajectory.size() << " samples; deviation "
            << motion.deviation.measured.position << " m measured, at most "
            << motion.deviation.bound.position << " m at any time\n";
  write_trajectory("05_straight_line.csv", motion.trajectory);
  save(motion_figure(rrr, motion.trajectory, poses), "05_straight_line.svg");
}
