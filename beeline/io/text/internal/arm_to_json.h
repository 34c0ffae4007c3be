#pragma once

#include <string>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Returns arm_to_json() with further members of the document, each with a comma in front.
std::string arm_to_json_with(const Arm& arm, const std::string& members);

}  // namespace beeline::internal
