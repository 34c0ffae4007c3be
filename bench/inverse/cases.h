#pragma once

#include <string>
#include <vector>

#include "arms.h"

namespace beeline::bench {

/// A question that every solver of the benchmark is asked. The peers in peers.py take the names.
enum class CaseKind {
  all_solutions,            ///< limits do not count
  within_limits,            ///< one solution, by the method that is chosen by itself
  numerical_within_limits,  ///< one solution
  numerical_free,           ///< one solution, limits do not count
  tracking,                 ///< numerical, from a seed within 0.1 rad, within limits
};

struct Case {
  CaseKind kind;
  std::string name;
  bool limits;  ///< a solution outside them is none

  bool near_seed() const { return kind == CaseKind::tracking; }
};

/// The cases that are asked of this arm: all solutions only where they are finitely many, and that
/// alone where the last joint is given.
std::vector<Case> cases_of(const BenchArm& arm);

}  // namespace beeline::bench
