#pragma once

#include <vector>

#include <beeline/planning/branch.h>

#include "output.h"

/// What becomes of each of the arm's branches along lines, for `line --branches`.
void print_branches(const beeline::Arm& arm, const std::vector<beeline::Branch>& branches,
                    const UnitArgument& unit);
OrderedJson json_branches(const beeline::Arm& arm, const std::vector<beeline::Branch>& branches,
                          const UnitArgument& unit);
