#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace beeline::internal {

struct JsonMember;

/// One value of a JSON document, with its line in the file.
struct Json {
  using Items = std::vector<Json>;
  using Members = std::vector<JsonMember>;  ///< in the file's order

  std::variant<std::nullptr_t, bool, double, std::string, Items, Members> value;
  int line = 0;
};

struct JsonMember {
  std::string key;
  Json value;
};

/// A parsed JSON text with checked access. Every error is a FileError that names the line and the
/// value's path: `arm.json:7: joints[2].limits.lower must be a number, not text`.
/// Returned references point into the document.
class JsonDocument {
 public:
  /// Throws FileError for text that is not JSON, a repeated key, nesting deeper than 64 levels,
  /// objects of more than 32 keys and documents of more than 8 million values. These bounds keep
  /// memory and stack bounded for any text.
  JsonDocument(std::string_view text, std::string path);

  /// A document that was parsed, or a value of one, whose path in the document is `place`.
  JsonDocument(Json root, std::string path, std::string place = "");

  const Json& root() const { return root_; }

  // Each returns the value when it has this type, and refuses it otherwise.
  double number(const Json& json) const;
  bool truth(const Json& json) const;
  const std::string& text(const Json& json) const;
  const Json::Items& items(const Json& json) const;
  const Json::Members& members(const Json& json) const;
  std::vector<double> numbers(const Json& json, std::size_t count) const;  ///< a list of `count`

  /// Returns the member of an object; when it is missing, find() returns null and need() refuses
  /// the object.
  const Json* find(const Json& object, std::string_view key) const;
  const Json& need(const Json& object, std::string_view key) const;

  /// Refuses an object that has a key other than the `known` ones.
  void check_keys(const Json& object, const std::vector<std::string>& known) const;

  /// Throws FileError: the path of `at`, then `message`.
  [[noreturn]] void refuse(const Json& at, const std::string& message) const;

 private:
  std::string place_of(const Json& json) const;

  std::string path_, place_;
  Json root_;
};

}  // namespace beeline::internal
