#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline::bench {

/// An arm that is measured. With `last` its last joint stands still at that value, so that an arm
/// of seven joints has finitely many solutions.
struct BenchArm {
  std::string name;
  Arm arm;
  std::optional<double> last = std::nullopt;

  int free() const { return arm.dof() - (last ? 1 : 0); }  ///< joints that move
};

/// The names of all that are measured.
std::vector<std::string> bench_arm_names();

/// Throws Error for another name, naming these.
BenchArm bench_arm(const std::string& name);

}  // namespace beeline::bench
