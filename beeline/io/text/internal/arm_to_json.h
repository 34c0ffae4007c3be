#pragma once

#include <string>

#include <beeline/collision/scene.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Whether an arm file describes the body as attached to its link: it cannot say that a body is at
/// one of two joints alone. The base has no joint in front of it, and the last link none behind it.
bool is_attached_in_file(const Arm& arm, const LinkShapes& body);

/// Returns arm_to_json() with further members of the document, each with a comma in front.
std::string arm_to_json_with(const Arm& arm, const std::string& members);

}  // namespace beeline::internal
