#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <beeline/error.h>

namespace beeline::internal {

/// The identifier of an enumerator; empty for a value that has none. GCC and Clang end a function's
/// signature by "[... value = beeline::Ending::cancelled]", or by "(beeline::Ending)7" for a value
/// without a name.
template <auto value>
consteval std::string_view signature_identifier() {
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_prefix(text.find("value = ") + 8);
  text = text.substr(0, text.find_first_of(";]"));
  return text.starts_with('(') ? "" : text.substr(text.rfind(':') + 1);
}

/// The letters of an enumerator's identifier, without the signature around them.
template <auto value>
inline constexpr auto identifier_letters = [] {
  constexpr std::string_view identifier = signature_identifier<value>();
  std::array<char, identifier.size()> letters;
  std::copy(identifier.begin(), identifier.end(), letters.begin());
  return letters;
}();

/// The number of enumerators of an enumeration that counts from 0.
template <typename Enum, std::size_t known = 0>
consteval std::size_t enumerator_count() {
  if constexpr (signature_identifier<static_cast<Enum>(known)>().empty())
    return known;
  else
    return enumerator_count<Enum, known + 1>();
}

/// The names of the enumerators of an enumeration that counts from 0, in their order.
template <typename Enum>
class EnumNames {
 public:
  static constexpr std::size_t count = enumerator_count<Enum>();
  static_assert(count > 0 && signature_identifier<static_cast<Enum>(count + 1)>().empty(),
                "enumerators count from 0 without a gap");

  /// The names are the identifiers. `what` is the kind of name in errors.
  consteval explicit EnumNames(std::string_view what) : what_(what) {
    [this]<std::size_t... i>(std::index_sequence<i...>) {
      ((names_[i] = {identifier_letters<static_cast<Enum>(i)>.data(),
                     identifier_letters<static_cast<Enum>(i)>.size()}),
       ...);
    }
    (std::make_index_sequence<count>());
  }

  /// `names` are separated by single spaces.
  consteval EnumNames(std::string_view what, std::string_view names) : what_(what) {
    for (std::string_view& name : names_) {
      if (names.empty()) throw "too few names";
      const std::size_t end = std::min(names.find(' '), names.size());
      name = names.substr(0, end);
      names.remove_prefix(std::min(end + 1, names.size()));
    }
    if (!names.empty()) throw "too many names";
  }

  /// Throws std::out_of_range for a value that is not an enumerator.
  std::string of(Enum value) const {
    return std::string(names_.at(static_cast<std::size_t>(value)));
  }

  std::vector<std::string> all() const { return {names_.begin(), names_.end()}; }

  /// Returns the enumerator of a name. Throws Error, which lists all names, for another name.
  Enum named(std::string_view name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) throw unknown_name(what_, name, all());
    return static_cast<Enum>(found - names_.begin());
  }

 private:
  std::string_view what_;
  std::array<std::string_view, count> names_;
};

}  // namespace beeline::internal
