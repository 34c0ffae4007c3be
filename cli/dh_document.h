#pragma once

#include <string>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/json.h>

#include "arguments.h"

namespace beeline::command {

/// The DH table as text, with base and tool, and how each frame that the axes leave open was
/// chosen. Without a table: which joints have no row, and why.
std::string dh_text(const Arm& arm, const DhTable& table, const UnitArgument& unit);

/// The same as data: `convention`, `base`, `rows` with the keys of an arm file, `tool`, and
/// `freedom` of frames 0 to n; or `misfits`.
Json dh_document(const Arm& arm, const DhTable& table, const UnitArgument& unit);

}  // namespace beeline::command
