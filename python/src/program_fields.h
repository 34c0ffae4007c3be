#pragma once

#include <beeline/planning/program.h>

#include "planning_fields.h"

namespace beeline::python {

template <>
struct Fields<Move> : Members<&Move::kind, &Move::target, &Move::q, &Move::via, &Move::speed,
                              &Move::blend, &Move::dwell, &Move::place> {
  static constexpr std::size_t required = 1;
};

template <>
struct Fields<Attachment>
    : Members<&Attachment::part, &Attachment::after, &Attachment::until, &Attachment::touch,
              &Attachment::place, &Attachment::detach_place> {
  static constexpr std::size_t required = 1;
};

template <>
struct Fields<AttachedPart>
    : Members<&AttachedPart::part, &AttachedPart::attached, &AttachedPart::detached,
              &AttachedPart::tool_T_part, &AttachedPart::touch> {};

template <>
struct Fields<Program> : Members<&Program::moves, &Program::attachments> {
  static constexpr std::size_t required = 1;
};

template <>
struct Fields<PlannedMove>
    : Members<&PlannedMove::begin, &PlannedMove::end, &PlannedMove::bound, &PlannedMove::tool_speed,
              &PlannedMove::blend_radius, &PlannedMove::joint_blend_radius, &PlannedMove::blend,
              &PlannedMove::waypoints> {};

template <>
struct Fields<ProgramMotion>
    : Members<&ProgramMotion::status, &ProgramMotion::reason, &ProgramMotion::failed,
              &ProgramMotion::search_ending, &ProgramMotion::trajectory, &ProgramMotion::moves,
              &ProgramMotion::deviation, &ProgramMotion::limits, &ProgramMotion::recovery,
              &ProgramMotion::limit_margin, &ProgramMotion::inverse_condition> {};

}  // namespace beeline::python
