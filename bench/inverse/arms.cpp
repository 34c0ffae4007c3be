#include "arms.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <beeline/error.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

namespace beeline::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double given = 0.5;  // radians, value of a locked last joint

Arm six_joints(const std::string& name, const std::array<DhRow, 6>& rows) {
  std::vector<Joint> joints;
  for (const DhRow& row : rows) {
    Joint joint = dh_joint(row, DhConvention::standard);
    joint.name = "joint" + std::to_string(joints.size() + 1);
    joint.limits = {.lower = -pi, .upper = pi};
    joints.push_back(joint);
  }
  return {name, joints};
}

/// A general geometry: no two axes meet, are parallel or at right angles.
Arm general_6r() {
  return six_joints("general_6r", {{{.a = 0.12, .alpha = -1.31, .d = 0.35, .theta = 0.0},
                                    {.a = 0.41, .alpha = 0.37, .d = 0.07, .theta = 0.4},
                                    {.a = 0.17, .alpha = 1.13, .d = -0.05, .theta = -0.7},
                                    {.a = -0.06, .alpha = -1.02, .d = 0.38, .theta = 0.2},
                                    {.a = 0.09, .alpha = 1.24, .d = 0.06, .theta = 0.9},
                                    {.a = 0.04, .alpha = 0.55, .d = 0.11, .theta = -0.3}}});
}

/// The first arm known to have sixteen solutions: Manseur & Doty, "A robot manipulator
/// with 16 real inverse kinematic solution sets", IJRR 8(5), 1989.
Arm sixteen() {
  constexpr double degree = pi / 180;
  return six_joints("sixteen", {{{.a = 0.3, .alpha = pi / 2},
                                 {.a = 1, .alpha = degree},
                                 {.alpha = pi / 2, .d = 0.2},
                                 {.a = 1.5, .alpha = degree},
                                 {.alpha = pi / 2},
                                 {.alpha = degree}}});
}

/// A UR5 with typical calibration offsets: 1e-4 rad in the parallel axes, tenths of millimetres in
/// the lengths.
Arm ur5_calibrated() {
  return six_joints("ur5_calibrated",
                    {{{.a = 1e-4, .alpha = pi / 2 + 1e-4, .d = 0.0892, .theta = 2e-5},
                      {.a = -0.4252, .alpha = 1e-4, .d = 3e-4, .theta = -1e-4},
                      {.a = -0.3921, .alpha = -1.3e-4, .d = -2e-4, .theta = 3e-4},
                      {.a = -1e-4, .alpha = pi / 2 - 2e-4, .d = 0.1091, .theta = 1e-4},
                      {.a = 5e-5, .alpha = -pi / 2 + 1e-4, .d = 0.0947, .theta = -2e-4},
                      {.d = 0.0823}}});
}

}  // namespace

std::vector<std::string> bench_arm_names() {
  return {"puma560", "ur5",      "stanford",  "general_6r", "panda",
          "iiwa14",  "panda_q7", "iiwa14_q7", "sixteen",    "ur5_calibrated"};
}

BenchArm bench_arm(const std::string& name) {
  const std::vector<std::string> names = bench_arm_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw unknown_name("arm", name, names);
  }
  for (const Arm& own : {general_6r(), sixteen(), ur5_calibrated()}) {
    if (own.name() == name) return {name, own};
  }
  const std::size_t suffix = name.find("_q7");
  if (suffix == std::string::npos) return {name, built_in(name)};
  return {name, built_in(name.substr(0, suffix)), given};
}

}  // namespace beeline::bench
