#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline::bench {

/// An arm of the benchmark. With `last`, its last joint is locked at that value, so that an arm of
/// seven joints has finitely many solutions.
struct BenchArm {
  std::string name;
  Arm arm;
  std::optional<double> last = std::nullopt;

  int free() const { return arm.dof() - (last ? 1 : 0); }  ///< number of joints that are not locked
};

/// Returns the names of all arms of the benchmark.
std::vector<std::string> bench_arm_names();

/// Throws Error for an unknown name; the message lists the known ones.
BenchArm bench_arm(const std::string& name);

}  // namespace beeline::bench
