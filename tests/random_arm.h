#pragma once

#include <string>
#include <vector>

#include <tests/random.h>

namespace beeline::testing {

/// A joint of the kind with any axis, anywhere, in an offset of any pose; within +-3 (R), +-2.
inline Joint random_joint(Random& random, JointKind kind, const std::string& name) {
  Joint joint;
  joint.name = name;
  joint.offset = random.pose();
  if (kind == JointKind::prismatic) {
    joint.screw = translation_screw(random.direction());
  } else {
    const double pitch = kind == JointKind::helical ? random.uniform(0.05, 0.5) : 0;
    joint.screw = rotation_screw(random.direction(), random.vector(), pitch);
  }
  joint.limits = {.lower = -3, .upper = 3};
  if (kind != JointKind::revolute) joint.limits = {.lower = -2, .upper = random.uniform(-1, 2)};
  return joint;
}

/// An arm of `joints` joints of random kinds, about one in `mimics` of them a follower of an
/// earlier one (0: none); base and tool anywhere.
inline Arm random_arm(Random& random, int joints, int mimics = 0) {
  std::vector<Joint> chain;
  for (int i = 0; i < joints; ++i) {
    const auto kind = static_cast<JointKind>(random.integer(0, 2));
    chain.push_back(random_joint(random, kind, "j" + std::to_string(i)));
    if (i == 0 || mimics == 0 || random.integer(1, mimics) != 1) continue;
    chain.back().limits = {};
    chain.back().mimic = Mimic{"j" + std::to_string(random.integer(0, i - 1)),
                               random.uniform(-1.5, 1.5), random.uniform(-1, 1)};
  }
  return {"random", chain, random.pose(), random.pose(2)};
}

}  // namespace beeline::testing
