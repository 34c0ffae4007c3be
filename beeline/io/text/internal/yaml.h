#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <beeline/io/text/json.h>

namespace beeline::internal {

struct YamlMember;

/// One value of a YAML document, with its line in the file.
struct Yaml {
  using Items = std::vector<Yaml>;
  using Members = std::vector<YamlMember>;  ///< in the file's order

  std::variant<std::string, Items, Members> value;  ///< a scalar is its text, null is empty
  /// As written, such as `!degrees`; `!` for a text in quotes, empty or `?` where there is none.
  std::string tag;
  int line = 0;
};

struct YamlMember {
  std::string key;
  int line = 0;  ///< of the key
  Yaml value;
};

/// Bounds of the content of a YAML text.
struct YamlBounds {
  std::size_t bytes = std::size_t{1} << 20;
  /// Copies of aliases included; each 64 bytes of a text count as one more.
  std::size_t values = 100'000;
};

/// Parses a YAML text of one document; `path` names it in messages, `first_line` is its first line
/// in the file. An alias becomes a copy of the named value. A merge key (<<) adds the members of
/// its map that this map lacks. Throws FileError for text that is not YAML, a second document, a
/// repeated key, a key that is not a scalar, an alias inside its own anchor, a line of more than
/// 1 MiB, a text beyond the bounds and nesting deeper than 64 levels. These bounds keep memory,
/// time and stack bounded for any text.
Yaml parse_yaml(std::string_view text, const std::string& path, const YamlBounds& bounds = {},
                int first_line = 1);

/// Returns a JSON value. Its texts are texts in quotes, its whole numbers have no point.
Yaml as_yaml(const Json& json);

}  // namespace beeline::internal
