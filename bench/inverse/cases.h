#pragma once

#include <string>
#include <vector>

#include "arms.h"

namespace beeline::bench {

/// A problem that every solver of the benchmark is given. peers.py uses the same names.
enum class CaseKind {
  all_solutions,            ///< limits ignored
  within_limits,            ///< one solution, by the automatic method
  numerical_within_limits,  ///< one solution
  numerical_free,           ///< one solution, limits ignored
  tracking,                 ///< numerical, from a seed within 0.1 rad, within limits
};

struct Case {
  CaseKind kind;
  std::string name;
  bool limits;  ///< solutions outside the limits are rejected

  bool near_seed() const { return kind == CaseKind::tracking; }
};

/// Returns the cases for this arm: all solutions only where they are finitely many, and only that
/// case when the last joint is locked.
std::vector<Case> cases_of(const BenchArm& arm);

}  // namespace beeline::bench
