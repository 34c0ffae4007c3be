// The Jacobian (Dellaert, *Serial Link Manipulators*, eq. 1.4 and Figure 1.8) and manipulability.
#include <iostream>
#include <numbers>

#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>

int main() {
  const beeline::Arm rrr = beeline::built_in("rrr");
  const Eigen::Vector3d q(0, std::numbers::pi / 2, 0);
  const Eigen::Matrix3Xd j = planar_jacobian(rrr, q);
  std::cout << "rows x, y, theta; one column for each joint:\n" << j << '\n';
  std::cout << "manipulability " << beeline::manipulability_measures(j).manipulability << '\n';

  const beeline::Arm panda = beeline::built_in("panda");
  const beeline::Configuration middle = middle_configuration(panda);
  std::cout << "panda, in tool axes, rows vx vy vz wx wy wz:\n"
            << jacobian(panda, middle, beeline::Frame::tool) << '\n';
}
