#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/io/text/internal/column_unit.h>
#include <beeline/trajectory/internal/joint_columns.h>

namespace beeline::internal {

/// Returns the column of the recording that a name of the joint map means; none if there is none.
std::optional<std::size_t> mapped_column(const ColumnsInUnits& columns, const std::string& name);

/// Throws Error if the arm's own names are columns beside the columns that are read as positions,
/// or if the name of one of these states another quantity or unit, apart from the joint's name.
void check_positions(const Arm& arm, const ColumnsInUnits& columns, const JointColumns& order);

}  // namespace beeline::internal
