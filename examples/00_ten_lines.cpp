// Ten lines: an arm, its tool pose, its Jacobian, inverse kinematics and a straight line.
#include <iostream>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/planning/move_along.h>

int main() {
  const beeline::Arm arm = beeline::read_arm("panda");  // or "robot.urdf", or "RRR:3.5,3.5,2"
  const beeline::Configuration q = middle_configuration(arm);
  const beeline::Pose tool = forward_kinematics(arm, q);
  const beeline::Jacobian j = jacobian(arm, q);  // base frame, rows vx vy vz wx wy wz
  const beeline::Pose higher = Eigen::Translation3d(0, 0, 0.1) * tool;
  const auto answer = inverse_kinematics(arm, higher, {.seed = q});
  const auto motion = move_in_lines(arm, q, {higher, tool});
  std::cout << "tool\n" << tool.matrix() << "\nJacobian\n" << j << '\n';
  std::cout << "inverse kinematics: " << name(answer.status) << answer.reason << '\n';
  std::cout << "up and down: " << name(motion.status) << ", deviation at most "
            << motion.deviation.bound.position << " m\n"
            << motion.reason;
}
