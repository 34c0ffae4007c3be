// Proportional joint control (Dellaert, *Serial Link Manipulators*, eq. 1.3): a small gain K_p is
// slow, a large one overshoots, and 2 does not converge.
#include <iostream>
#include <numbers>

#include <beeline/control/joint.h>
#include <beeline/model/catalog.h>

int main() {
  constexpr double deg = std::numbers::pi / 180;
  const beeline::Arm rrr = beeline::built_in("rrr");
  const Eigen::Vector3d start(0, 0, 0);
  const Eigen::Vector3d goal(99.2 * deg, -68.8 * deg, -30.4 * deg);

  for (const double kp : {0.01, 0.1, 0.5, 1.0, 1.5, 2.1}) {
    const auto motion = control_joints(rrr, start, goal, {.kp = kp});
    std::cout << "K_p " << kp << ": " << name(motion.status) << " after " << motion.steps
              << " steps, overshoot " << 100 * motion.overshoot << " %  " << motion.reason << '\n';
  }
}
