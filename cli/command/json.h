#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// A JSON value: null, a truth value, a number, a string, a list, or an object whose members keep
/// the order in which they were added.
class Json {
 public:
  struct Member;
  using List = std::vector<Json>;
  struct Object {
    std::vector<std::string> keys;
    List values;  ///< one for each key
  };

  Json() = default;  ///< null
  Json(std::nullptr_t) {}
  Json(bool value) : value_(value) {}
  template <std::integral Integer>
  Json(Integer value) : value_(static_cast<std::int64_t>(value)) {}
  Json(double value);  ///< null if infinite or NaN, which JSON cannot represent
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  template <class Value>
  Json(const std::optional<Value>& value) {
    if (value) *this = Json(*value);
  }
  Json(const std::vector<std::string>& texts);
  Json(const Eigen::VectorXd& values);
  /// An object: Json{{"status", "solved"}, {"residual", 0.5}}.
  Json(std::initializer_list<Member> members);

  static Json object();
  static Json list();
  /// Appends to a list; null becomes a list.
  void append(Json element);
  /// Appends a member to an object; null becomes an object.
  void add(std::string key, Json value);
  void add(const Json& members);  ///< all members of another object; null has none

  /// The JSON text, indented by two spaces. Numbers read back exactly; bytes that are not UTF-8
  /// become the replacement character.
  std::string text() const;

  const auto& value() const { return value_; }

 private:
  std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, List, Object> value_;
};

struct Json::Member {
  std::string key;
  Json value;
};
