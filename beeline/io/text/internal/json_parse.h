#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <beeline/io/text/file.h>
#include <beeline/io/text/json.h>

namespace beeline::internal {

/// A list of a document that may be of any length: the member `key` of the document's object. Its
/// items are handed over one by one, in their order, and the list remains empty.
struct JsonItemSink {
  std::string key;
  /// `root` is the document as far as it was read.
  std::function<void(const Json& root, Json item)> take;
};

/// What may stand before a JSON text: blanks, or YAML's comments and `---` too, since JSON is YAML.
enum class JsonFront { blanks, yaml_comments };

/// Parses a JSON text; `path` names it in messages. Throws FileError as JsonDocument documents; the
/// number of values is limited for each item of the sink separately.
Json parse_json(std::string_view text, const std::string& path, const JsonItemSink& sink = {},
                JsonFront front = JsonFront::blanks);

/// The same from a file of any size, which is read in blocks.
Json parse_json(InputFile& file, const JsonItemSink& sink = {},
                JsonFront front = JsonFront::blanks);

}  // namespace beeline::internal
