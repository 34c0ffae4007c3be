#pragma once

#include <beeline/collision/collision_model.h>
#include <beeline/planning/program.h>

namespace beeline::internal {

/// Throws AttachmentError for an attachment that no scene makes valid; see move_program(). Requires
/// a program with moves that are valid.
void check_attachments(const Program& program);

/// Does the same, and throws for a part or a name in Attachment::touch that the model does not
/// have, and for a part that cannot be carried.
void check_attachments(const Program& program, const CollisionModel& model);

}  // namespace beeline::internal
