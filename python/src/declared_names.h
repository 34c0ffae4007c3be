#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace beeline::python {

/// The last name in the text in which a compiler states a template's argument:
/// `... [with auto value = &beeline::Line::from; ...]`.
constexpr std::string_view last_name(std::string_view text) {
  text.remove_prefix(text.find(" = ") + 3);
  text = text.substr(0, text.find_first_of(";]"));
  return text.substr(text.rfind(':') + 1);  // npos + 1 is 0
}

/// The name of a member or an enumerator, without its scopes.
template <auto value>
constexpr std::string_view declared_name() {
  return last_name(static_cast<const char*>(__PRETTY_FUNCTION__));
}
/// The name of a type, without its scopes.
template <class T>
constexpr std::string_view declared_name() {
  return last_name(static_cast<const char*>(__PRETTY_FUNCTION__));
}

/// A name that ends with a zero, as Python has it: `from`, a keyword, is `from_`.
template <std::size_t size>
constexpr std::array<char, size + 2> python_name(std::string_view declared) {
  std::array<char, size + 2> text{};
  for (std::size_t i = 0; i < size; ++i) text[i] = declared[i];
  if (declared == "from") text[size] = '_';
  return text;
}
template <auto Member>
inline constexpr auto member_name =
    python_name<declared_name<Member>().size()>(declared_name<Member>());
template <class T>
inline constexpr auto struct_name = python_name<declared_name<T>().size()>(declared_name<T>());

/// The number of an enumeration's values, which count from 0: the next one has no name but is
/// `(beeline::Frame)3`.
template <class Enum, std::size_t count = 0>
constexpr std::size_t enumerator_count() {
  if constexpr (declared_name<static_cast<Enum>(count)>().find(')') != std::string_view::npos) {
    return count;
  } else {
    return enumerator_count<Enum, count + 1>();
  }
}

/// The names of an enumeration's values in C++.
template <class Enum>
inline constexpr auto enumerators = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array{declared_name<static_cast<Enum>(I)>()...};
}
(std::make_index_sequence<enumerator_count<Enum>()>());

}  // namespace beeline::python
