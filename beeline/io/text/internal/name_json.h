#pragma once

#include <string>

#include <beeline/io/text/json.h>

namespace beeline::internal {

/// Reads a name of an arm's parts or of a body. Throws FileError for one that check_name() refuses.
std::string name_from_json(const JsonDocument& document, const Json& json);

}  // namespace beeline::internal
