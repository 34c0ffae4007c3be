#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace beeline {

struct JsonMember;

/// One value of a JSON document, with the line it stands on.
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

/// A JSON text and the questions its readers ask. Every refusal is a FileError that names line
/// and place, as in `arm.json:7: joints[2].limits.lower must be a number, not text`.
/// References are into the document.
class JsonDocument {
 public:
  /// Throws FileError for text that is no JSON, a key given twice, nesting deeper than 64, objects
  /// of more than 32 keys and documents of more than 8 million values: whatever the text, memory
  /// and stack stay bounded.
  JsonDocument(std::string_view text, std::string path);

  const Json& root() const { return root_; }

  double number(const Json& json) const;
  const std::string& text(const Json& json) const;
  const Json::Items& items(const Json& json) const;
  const Json::Members& members(const Json& json) const;
  std::vector<double> numbers(const Json& json, std::size_t count) const;

  /// The member of an object, null when there is none; `need` refuses the object then.
  const Json* find(const Json& object, std::string_view key) const;
  const Json& need(const Json& object, std::string_view key) const;

  /// Refuses an object with a key that is not among `known`.
  void check_keys(const Json& object, const std::vector<std::string>& known) const;

  /// Throws: place of `at`, then `message`.
  [[noreturn]] void refuse(const Json& at, const std::string& message) const;

 private:
  std::string path_;
  Json root_;
};

/// Text as JSON writes it, in quotes. Throws Error when it is not UTF-8.
std::string json_text(std::string_view text);

/// A list of numbers, on one line, exact.
std::string json_numbers(const double* values, std::size_t count);

}  // namespace beeline
