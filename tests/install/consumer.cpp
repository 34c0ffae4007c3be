#include <cstdio>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

int main() {
  const beeline::Arm arm = beeline::built_in("rrr");
  const beeline::Pose pose = beeline::forward_kinematics(arm, Eigen::VectorXd::Zero(arm.dof()));
  std::printf("%.3f %.3f\n", pose.translation().x(), pose.translation().y());
}
