#pragma once

#include <string>

#include <beeline/io/text/json.h>
#include <beeline/planning/program.h>

#include "arguments.h"

namespace beeline::command {

/// Lines on the blend of a joint move after a move of a program; empty if it has none.
std::string blend_text(const PlannedBlend& blend, const UnitArgument& unit);

/// The same as data; null if it has none.
Json blend_document(const PlannedBlend& blend, const UnitArgument& unit);

/// A line for each part in which a blend with a joint move leaves a line.
std::string passed_text(const Verification& verification, const Program& program,
                        const UnitArgument& unit);

/// The samples at which segments or moves end, and the waypoints that blends pass.
Json arrival_members(const Verification& verification, const UnitArgument& unit);

}  // namespace beeline::command
