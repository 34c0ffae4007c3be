// Ten lines: an arm, the pose of its tool, inverse kinematics and a straight line.
#include <iostream>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/move_along.h>

int main() {
  const beeline::Arm arm = beeline::read_arm("panda");  // or "robot.urdf", or "RRR:3.5,3.5,2"
  const beeline::Configuration q = middle_configuration(arm);
  const beeline::Pose lower = Eigen::Translation3d(0, 0, -0.1) * forward_kinematics(arm, q);
  const auto found = inverse_kinematics(arm, lower, {.seed = q});
  const auto motion = move_in_lines(arm, q, {lower});
  std::cout << found << '\n' << motion << '\n';  // a negative answer prints its reason
}
