#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <beeline/error.h>

namespace beeline {

/// A JSON value, read from a text or made to be written.
struct Json {
  struct Member;
  using Items = std::vector<Json>;
  using Members = std::vector<Member>;  ///< in the order of the text, or in which they were added

  Json() = default;  ///< null
  Json(std::nullptr_t);
  Json(bool truth);
  template <std::integral Integer>
  Json(Integer number);
  Json(double number);  ///< null if infinite or NaN, which JSON cannot represent
  Json(const char* text);
  Json(std::string text);
  template <class Value>
  Json(const std::optional<Value>& given) {  ///< null if there is none
    if (given) *this = Json(*given);
  }
  Json(const std::vector<std::string>& texts);
  Json(const Eigen::VectorXd& numbers);
  /// An object: Json{{"status", "solved"}, {"residual", 0.5}}.
  Json(std::initializer_list<Member> members);

  static Json object();
  static Json list();
  /// Appends to a list; null becomes a list.
  void append(Json item);
  /// Appends a member to an object, or replaces the one with this key; null becomes an object.
  void add(std::string key, Json member);
  void add(const Json& members);  ///< all members of another object; null has none

  /// Returns the JSON text, indented by two spaces. Numbers read back exactly; bytes that are not
  /// UTF-8 become the replacement character.
  std::string text() const;

  /// A number that was read is a double; whole numbers are only in values that a program made.
  std::variant<std::nullptr_t, bool, double, std::string, Items, Members, std::int64_t> value;
  int line = 0;  ///< of the text that it was read from, from 1
};

struct Json::Member {
  std::string key;
  Json value;
};

template <std::integral Integer>
Json::Json(Integer number) : value(static_cast<std::int64_t>(number)) {}

/// A parsed JSON text with checked access. Every error is a FileError that names the line and the
/// value's path: `arm.json:7: joints[2].limits.lower must be a number, not text`.
/// Returned references point into the document.
class JsonDocument {
 public:
  /// Throws FileError for text that is not JSON, a repeated key, nesting deeper than 64 levels,
  /// objects of more than 32 keys and documents of more than 8 million values. These bounds keep
  /// memory and stack bounded for any text.
  template <std::convertible_to<std::string_view> Text>
  JsonDocument(const Text& text, const std::string& path) : JsonDocument(parse(text, path), path) {}

  /// A document that was parsed, or a value of one, whose path in the document is `place`.
  JsonDocument(Json root, std::string path, std::string place = "");

  const Json& root() const { return root_; }
  const std::string& path() const { return path_; }  ///< of the file

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
  static Json parse(std::string_view text, const std::string& path);
  std::string place_of(const Json& json) const;

  std::string path_, place_;
  Json root_;
};

}  // namespace beeline
