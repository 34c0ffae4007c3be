// Inverse kinematics: both elbow solutions of the planar arm, and the reason when there is none.
#include <iostream>
#include <numbers>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se2.h>

int main() {
  constexpr double deg = std::numbers::pi / 180;
  const beeline::Arm rrr = beeline::built_in("rrr");

  const beeline::Pose goal = beeline::to_space({.x = 4.459, .y = 5.226, .theta = 0});
  for (const auto& q : inverse_kinematics(rrr, goal, {.all = true}).solutions) {
    std::cout << "solution: " << q.transpose() / deg << " deg\n";
  }

  const beeline::Pose far = beeline::to_space({.x = 8, .y = 8, .theta = 0});
  beeline::InverseResult no = inverse_kinematics(rrr, far);
  explain(no);  // searches for the nearest configuration
  std::cout << name(no.status) << ": " << no.reason << '\n';
}
