// Obstacles: a motion that is proved to keep its clearance, one that collides, and free solutions.
#include <iostream>
#include <string>

#include <beeline/certificate/clearance.h>
#include <beeline/control/joint.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/scene.h>
#include <beeline/kinematics/forward.h>

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : ".";  // with the arm and the scene
  const std::string file = folder + "/planar_arm.json";
  const beeline::Arm arm = beeline::read_arm(file);
  const beeline::CollisionModel model(arm, beeline::read_arm_shapes(file).links,
                                      beeline::read_scene(folder + "/cell.json"));

  const beeline::Configuration start{{0, 1.57, 0}};
  for (const beeline::Configuration& goal :
       {beeline::Configuration{{-0.3, 1.2, 0.3}}, beeline::Configuration{{2.1, 0, 0}}}) {
    const beeline::Trajectory motion = move_joints(arm, start, goal).trajectory;
    const beeline::ClearanceProof proof = prove_clearance(model, motion, {.closest = true});
    std::cout << proof.status << ": ";
    if (proof) {
      std::cout << "at least " << proof.least_distance << " m, closest " << proof.pair.names[0]
                << " and " << proof.pair.names[1] << " at " << proof.time << " s\n";
    } else {
      std::cout << proof.reason << '\n';
    }
  }

  // Of both solutions for a pose, one is free.
  const beeline::Pose pose =
      forward_kinematics(arm, beeline::Configuration{{0.486, 2.170, -0.561}});
  const auto blocked = [&](const beeline::ConfigurationRef& q) { return blocked_by(model, q); };
  const beeline::InverseResult result =
      inverse_kinematics(arm, pose, {.all = true, .blocked_by = blocked});
  std::cout << result.solutions.size() << " free";
  for (const auto& [q, reason] : result.blocked) std::cout << "; blocked: " << reason;
  std::cout << '\n';
}
