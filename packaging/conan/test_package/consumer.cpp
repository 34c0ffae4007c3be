#include <cmath>

#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>

int main() {
  const beeline::Arm arm = beeline::read_arm("RRR:3.5,3.5,2");
  const beeline::Pose pose = beeline::forward_kinematics(arm, Eigen::VectorXd::Zero(arm.dof()));
  return std::abs(pose.translation().x() - 9) < 1e-12 ? 0 : 1;
}
