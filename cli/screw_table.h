#pragma once

#include <string>

#include <beeline/io/text/json.h>
#include <beeline/model/arm.h>

namespace beeline::command {

/// The arm as a product of exponentials: the screws of its joints in the world and in the tool, and
/// the pose of the tool, all at zero joint values (Lynch & Park, sections 4.1.1 and 4.1.3).
std::string screw_table(const Arm& arm);

/// The same as data: `home` (4 x 4), `rows` and, for each joint, `space` and `body`.
Json screw_document(const Arm& arm);

}  // namespace beeline::command
