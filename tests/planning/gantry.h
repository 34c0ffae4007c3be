#pragma once

#include <beeline/planning/program.h>

namespace beeline::testing {

inline Move joint_move(const Configuration& q) { return {.kind = MoveKind::joint, .q = q}; }

inline Obstacle box(const std::string& name, const Vector3& centre, const Vector3& size) {
  return {.name = name, .shapes = {{Box{size}, make_pose(centre, Rotation::Identity())}}};
}

/// Three slides along the world's axes with a gripper below the last one, above a table with a part
/// and a wall. The gripper is a small box above the tool, which is its lower end.
struct Gantry {
  Gantry() {
    std::vector<Joint> slides;
    for (int i = 0; i < 3; ++i) {
      slides.push_back(composite_joint('P', std::string(1, "xyz"[i])).front());
      slides.back().screw = translation_screw(Vector3::Unit(i));
      slides.back().limits = {.lower = -2, .upper = 2, .velocity = 1, .acceleration = 4};
    }
    arm = Arm("gantry", slides);
    links = {
        {.name = "gripper",
         .link = 3,
         .shapes = {{Box{Vector3(0.1, 0.1, 0.1)}, make_pose({0, 0, 0.05}, Rotation::Identity())}}}};
    scene.obstacles = {box("part", {0, 0, 0.1}, {0.2, 0.2, 0.2}),
                       box("table", {0, 0, -0.1}, {4, 1, 0.2}),
                       box("wall", {0.5, 0, 0.2}, {0.1, 1, 0.4})};
  }

  CollisionModel model() const { return {arm, links, scene}; }

  /// Down to the part, up by `lift`, over the wall, down, and up again. Attached without touching
  /// anything but `touch`; never if `attaches` is false.
  Program pick(double lift, const std::vector<std::string>& touch, bool attaches = true) const {
    Program program;
    for (const auto& [x, z] :
         {std::pair{0.0, 0.21}, {0.0, 0.21 + lift}, {1.0, 0.21 + lift}, {1.0, 0.21}, {1.0, 1.0}}) {
      program.moves.push_back(joint_move(Configuration{{x, 0, z}}));
    }
    if (attaches) program.attachments = {{.part = "part", .after = 1, .until = 4, .touch = touch}};
    return program;
  }

  Configuration above{{0, 0, 1}};
  Arm arm = Arm("empty", {composite_joint('P', "x").front()});
  std::vector<LinkShapes> links;
  Scene scene;
};

}  // namespace beeline::testing
