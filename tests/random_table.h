#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <beeline/model/joint.h>

#include <tests/random.h>

namespace beeline::testing {

/// A table as makers have them: right angles, zeros and lengths to a tenth of a millimetre.
inline std::vector<DhRow> random_rows(Random& random, int joints, bool prismatic = false) {
  const auto length = [&random] { return std::round(random.uniform(0.05, 0.6) * 1e4) / 1e4; };
  std::vector<DhRow> rows;
  for (int i = 0; i < joints; ++i) {
    DhRow row;
    const int link = random.integer(0, 3);
    if (link != 0) row.a = random.integer(0, 1) == 0 ? length() : -length();
    constexpr double angles[] = {0, 1, -1, 1, -1, 0.5};  // of pi / 2
    row.alpha = angles[random.integer(0, 5)] * std::numbers::pi / 2;
    if (link == 0 || random.integer(0, 2) == 0) row.d = length();
    if (row.a == 0 && row.alpha == 0) row.alpha = std::numbers::pi / 2;  // else one joint twice
    if (prismatic && i > 0 && i + 1 < joints && random.integer(0, 4) == 0) {
      row.kind = JointKind::prismatic;
    }
    rows.push_back(row);
  }
  return rows;
}

inline Arm arm_of_rows(const std::vector<DhRow>& rows, DhConvention convention,
                       const Pose& tool = Pose::Identity(), const Pose& base = Pose::Identity()) {
  std::vector<Joint> joints;
  for (const DhRow& row : rows) {
    Joint joint = dh_joint(row, convention);
    joint.name = "joint" + std::to_string(joints.size() + 1);
    joints.push_back(joint);
  }
  return {"table", joints, tool, base};
}

/// The same motion by other link frames: each joint's frame is moved along its link.
inline Arm with_other_frames(Random& random, const Arm& arm) {
  std::vector<Joint> joints = arm.joints();
  Pose before = Pose::Identity();
  for (Joint& joint : joints) {
    const Pose frame = random.pose(0.3);
    joint.offset = before * joint.offset;
    joint = with_link_frame(joint, frame);
    before = frame.inverse();
  }
  return {arm.name(), joints, before * arm.tool(), arm.base()};
}

/// Joint i with the coordinate q' = gain * q + offset.
inline Arm with_coordinates(const Arm& arm, const std::vector<double>& gain,
                            const std::vector<double>& offset) {
  std::vector<Joint> joints = arm.joints();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i].offset = joints[i].offset * screw_motion(joints[i].screw, -offset[i] / gain[i]);
    joints[i].screw *= gain[i];
  }
  return {arm.name(), joints, arm.tool(), arm.base()};
}

}  // namespace beeline::testing
