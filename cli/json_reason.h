#pragma once

#include <beeline/io/text/json.h>
#include <beeline/reason.h>

namespace beeline::command {

/// A reason in JSON, beside its sentence: the members `code`, null without a reason, and `fields`,
/// in metres, radians and seconds, with `details` where it rests on other reasons.
Json reason_members(const Reason& reason);

/// The members `reason`, its sentence, and reason_members().
Json json_reason(const Reason& reason);

}  // namespace beeline::command
