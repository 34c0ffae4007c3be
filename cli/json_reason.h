#pragma once

#include <beeline/reason.h>

#include "command/json.h"

/// A reason in JSON, beside its sentence: the members `code`, null without a reason, and `fields`,
/// in metres, radians and seconds, with `details` where it rests on other reasons.
Json reason_members(const beeline::Reason& reason);

/// The members `reason`, its sentence, and reason_members().
Json json_reason(const beeline::Reason& reason);
