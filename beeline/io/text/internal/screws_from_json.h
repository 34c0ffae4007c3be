#pragma once

#include <string>

#include <beeline/io/text/json.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Reads the member "screws" of an arm, a product of exponentials: see arm_from_screws(). Throws
/// FileError that names the value.
Arm arm_from_screws_json(const JsonDocument& document, const Json& screws, const std::string& name);

}  // namespace beeline::internal
