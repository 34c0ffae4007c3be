#pragma once

#include <string>

#include <beeline/certificate/verify.h>
#include <beeline/io/text/json.h>

namespace beeline::command {

/// A line for each kind of fault: the first, and the worst unless it is the first.
std::string faults_text(const Verification& verification);
Json json_faults(const Verification& verification);

}  // namespace beeline::command
