#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/urdf.h>

#include <tests/io/text/urdf_samples.h>

namespace beeline::testing {

using Kinds = std::vector<ReadWarningKind>;

struct Read {
  int dof = 0;
  std::vector<ReadWarning> warnings = {};
  Kinds kinds = {};
};

inline Read read(const std::string& elements, const ChainEnds& ends = {}) {
  Read result;
  const Arm arm = arm_from_urdf(robot(elements), "a.urdf", ends, &result.warnings);
  result.dof = arm.dof();
  for (const ReadWarning& warning : result.warnings) result.kinds.push_back(warning.kind);
  return result;
}

/// a - b - c, lines 2 to 6.
inline const std::string arm = link("a") + link("b") + link("c") +
                               joint("ab", "revolute", "a", "b") +
                               joint("bc", "revolute", "b", "c");

}  // namespace beeline::testing
