// Forward kinematics (Dellaert, *Serial Link Manipulators*, eq. 1.1 and Figure 1.6) of the
// chapter's planar arm and of a Panda.
#include <iostream>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se2.h>

int main() {
  constexpr double deg = std::numbers::pi / 180;

  const beeline::Arm rrr = beeline::built_in("rrr");
  const Eigen::Vector3d q(112 * deg, -52 * deg, -60 * deg);
  const beeline::Pose2 tool = beeline::to_plane(forward_kinematics(rrr, q));
  std::cout << "rrr:   x " << tool.x << ", y " << tool.y << ", theta " << tool.theta / deg
            << " deg\n";

  const beeline::Arm panda = beeline::built_in("panda");
  const beeline::Pose world_T_tool = forward_kinematics(panda, middle_configuration(panda));
  std::cout << "panda, all joints at the middle of their limits:\n"
            << world_T_tool.matrix() << '\n';
}
