#pragma once

#include <string>
#include <string_view>

#include <beeline/read/internal/json.h>

namespace beeline::internal {

/// Parses a JSON text; `path` names it in messages. Throws FileError as JsonDocument documents.
Json parse_json(std::string_view text, const std::string& path);

}  // namespace beeline::internal
