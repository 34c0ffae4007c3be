#pragma once

#include <vector>

#include <beeline/io/text/arm.h>

namespace tinyxml2 {
class XMLElement;
}

namespace beeline::internal {

/// Returns warnings of what a <joint> contains that is not read: an element or an attribute of
/// a name that URDF does not define, and a second element of one name. Names with a prefix, such as
/// <drake:limit>, belong to other programs. `moves`: the joint has one degree of freedom; the axis,
/// the limit and the leader of another one do not matter. The warnings do not name the joint.
std::vector<ReadWarning> ignored_parts(const tinyxml2::XMLElement& joint, bool moves);

/// Whether an element of <robot> appears to be a misspelt <joint> or <link>.
bool misspelt_part(const tinyxml2::XMLElement& element);

/// Whether the text that the warning is about is ignored, or describes a constant joint: it is no
/// error, also if it is of a joint on the chain.
bool is_ignored(ReadWarningKind kind);

/// Returns the names of URDF among which the ignored name of a warning may be meant.
std::vector<std::string> names_like(const ReadWarning& warning);

}  // namespace beeline::internal
