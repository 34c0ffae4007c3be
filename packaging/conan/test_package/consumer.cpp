#include <cstdio>

#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>

int main() {
  const beeline::Arm arm = beeline::read_arm("RRR:3.5,3.5,2");
  const beeline::Pose pose = beeline::forward_kinematics(arm, Eigen::VectorXd::Zero(arm.dof()));
  std::printf("%.3f %.3f\n", pose.translation().x(), pose.translation().y());
}
