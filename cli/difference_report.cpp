#include "difference_report.h"

#include <cmath>
#include <fmt/core.h>

using namespace beeline;

void print_difference(const Arm& arm, const TrajectoryDifference& apart, const UnitArgument& unit) {
  fmt::print("joint         largest       at s          rms\n");
  for (int k = 0; k < arm.dof(); ++k) {
    const JointDifference& joint = apart.joints[k];
    fmt::print("  {:<10}  {:<12}  {:<12}  {}\n", arm.joint_of(k).name,
               shown(unit.shown(arm, k, joint.largest)), shown(joint.time),
               shown(unit.shown(arm, k, joint.rms)));
  }
  fmt::print("tool          {} m at {} s, {} {} at {} s\n", shown(apart.largest_position),
             shown(apart.position_time), shown(unit.shown(apart.largest_orientation)), unit.name(),
             shown(apart.orientation_time));
  fmt::print("time          {} s compared; the second lasts {} s {}\n", shown(apart.overlap),
             shown(std::abs(apart.longer)), apart.longer < 0 ? "less" : "more");
}

OrderedJson json_difference(const Arm& arm, const TrajectoryDifference& apart,
                            const UnitArgument& unit) {
  OrderedJson joints = OrderedJson::array();
  for (int k = 0; k < arm.dof(); ++k) {
    const JointDifference& joint = apart.joints[k];
    joints.push_back({{"joint", arm.joint_of(k).name},
                      {"largest", json_number(unit.shown(arm, k, joint.largest))},
                      {"time", joint.time},
                      {"rms", json_number(unit.shown(arm, k, joint.rms))}});
  }
  return {{"joints", joints},
          {"position", json_number(apart.largest_position)},
          {"position_time", apart.position_time},
          {"orientation", json_number(unit.shown(apart.largest_orientation))},
          {"orientation_time", apart.orientation_time},
          {"overlap", apart.overlap},
          {"longer", apart.longer}};
}
