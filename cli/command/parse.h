#pragma once

#include <string>
#include <vector>

#include "verb.h"

namespace beeline::command {

/// Sets the targets of a verb's arguments and options from what was typed behind its name, and
/// returns the options that were typed, each under the name that was used. Throws Error naming the
/// option for a missing, unknown, repeated or unsuitable one.
std::vector<std::string> parse(const Verb& verb, const std::vector<std::string>& arguments);

}  // namespace beeline::command
