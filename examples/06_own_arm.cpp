// A custom arm: joints assembled by hand, written as JSON, read back, drawn.
#include <iostream>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se3.h>

int main() {
  // A crane: rotates about z, lifts along z, extends along x.
  std::vector<beeline::Joint> joints = beeline::composite_joint('C', "mast");
  joints[1].limits = {.lower = 0.2, .upper = 2, .velocity = 0.5};
  joints.push_back(beeline::composite_joint('P', "jib").front());
  joints.back().limits = {.lower = 1, .upper = 3, .velocity = 0.8};
  const beeline::Arm crane("crane", joints, beeline::make_pose({0, 0, -0.3}));

  write_arm_json("06_own_arm.json", crane);
  const beeline::Arm again = beeline::read_arm("06_own_arm.json");
  const auto q = middle_configuration(again);
  std::cout << again.name() << ": hook at "
            << forward_kinematics(again, q).translation().transpose() << '\n';
  save(arm_figure(again, q), "06_own_arm.svg");
}
