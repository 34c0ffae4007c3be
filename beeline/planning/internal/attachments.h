#pragma once

#include <beeline/collision/collision_model.h>
#include <beeline/planning/internal/waypoint_rests.h>
#include <beeline/planning/program.h>

namespace beeline::internal {

/// Throws AttachmentError for an attachment that no scene makes valid; see move_program(). Requires
/// a program with moves that are valid.
void check_attachments(const Program& program);

/// Does the same, and throws for a part or a name in Attachment::touch that the model does not
/// have, and for a part that cannot be carried.
void check_attachments(const Program& program, const CollisionModel& model);

/// Throws AttachmentError for an attachment at a waypoint at which the arm rests more than once
/// between the arrivals at the waypoints before and after it. Requires an arrival for each move.
void check_attachments(const Program& program, const Trajectory& trajectory,
                       const WaypointRests& rests, const std::vector<std::size_t>& arrivals);

}  // namespace beeline::internal
