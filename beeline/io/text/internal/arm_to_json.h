#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/collision/scene.h>
#include <beeline/io/text/scene.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Whether an arm file describes the body as attached to its link: it cannot say that a body is at
/// one of two joints alone. The base has no joint in front of it, and the last link none behind it.
bool is_attached_in_file(const Arm& arm, const LinkShapes& body);

/// Returns the shapes of an arm file of ours, see read_arm_shapes(). It has no joints beside the
/// chain: throws Error for `options.hold`.
ArmShapes shapes_from_arm_json(std::string_view text, const std::string& path,
                               const ChainEnds& ends, const ShapeOptions& options,
                               const std::vector<Srdf::State>& states);

/// Returns arm_to_json() with further members of the document, each with a comma in front.
std::string arm_to_json_with(const Arm& arm, const std::string& members);

}  // namespace beeline::internal
