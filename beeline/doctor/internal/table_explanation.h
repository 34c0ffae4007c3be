#pragma once

#include <optional>
#include <vector>

#include <beeline/doctor/internal/reconciliation.h>
#include <beeline/model/joint.h>

namespace beeline::internal {

/// The Denavit-Hartenberg rows of an arm whose link frames are those of the convention.
using DhTable = std::vector<DhRow>;
std::optional<DhTable> dh_table(const Arm& arm, DhConvention convention);

/// The arm with other rows; base, tool and names stay.
Arm with_rows(const Arm& arm, const DhTable& rows, DhConvention convention);

/// Explains B by A row by row, where both are tables of one convention with joints of equal kinds.
std::vector<Reconciliation> table_explanations(const Arm& a, const Arm& b, double tolerance);

}  // namespace beeline::internal
