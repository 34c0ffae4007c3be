#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "declared_names.h"
#include "header_text.h"
#include "value.h"

namespace beeline::python {

/// One public member of a struct: its name in Python and in C++.
template <class T, class M>
struct Field {
  const char* name;
  M T::*member;
  std::string_view declared;
};

template <auto Member, class T, class M>
constexpr Field<T, M> field(M T::*member) {
  return {member_name<Member>.data(), member, declared_name<Member>()};
}
template <class T, class M>
T struct_of(M T::*);

/// Describes a struct once, for its Python class, for keyword arguments, signatures and docstrings,
/// by its members: `struct Fields<Line> : Members<&Line::from, &Line::to>`. Names and docstrings
/// come from the declarations and their comments.
///
/// `name`, where Python has another one; where users make such objects, `constructible`, by
/// keywords, or `required`, the number of members that must be given, by position too; `as_tuple`
/// where an argument may be the tuple of its members; `check`, a function that throws for values
/// that such an object cannot have. A member of type Budget stands for the keywords time_limit,
/// max_work and progress.
template <class T>
struct Fields;

template <auto First, auto... Rest>
struct Members {
  static constexpr const char* name = struct_name<decltype(struct_of(First))>.data();
  static constexpr auto all() {
    // Without this constant the names are found in each call.
    constexpr std::tuple fields(field<First>(First), field<Rest>(Rest)...);
    return fields;
  }
};

template <class T>
inline constexpr bool is_described = requires {
  Fields<T>::name;
};

/// The number of members that the constructor needs.
template <class T>
constexpr std::size_t required_members = 0;
template <class T>
requires requires { Fields<T>::required; }
inline constexpr std::size_t required_members<T> = Fields<T>::required;

/// Whether the constructor takes members by position.
template <class T>
inline constexpr bool takes_positions = required_members<T> > 0 || requires {
  Fields<T>::positional;
};

/// The type of the member that a field describes.
template <class F>
struct MemberOf;
template <class T, class M>
struct MemberOf<Field<T, M>> {
  using Type = M;
};
template <class F>
using MemberType = typename MemberOf<std::decay_t<F>>::Type;

/// What the comment of the struct or of its member says; empty if there is none. What Python has as
/// arrays is described in python/src, else in the struct of C++ with the name that Python uses.
template <class T>
std::string comment_of(std::string_view member = {}) {
  std::string text = header_text(declared_name<T>(), member);
  return text.empty() ? header_text(Fields<T>::name, member) : text;
}

/// The docstring of the class; with "bool", of its truth value. Throws std::logic_error if there is
/// none: the module is not imported.
template <class T>
const char* struct_doc(std::string_view member = {}) {
  return docstring(comment_of<T>(member), Fields<T>::name, member);
}

/// The values of an enumeration with their meanings; empty if these are not described.
template <class Enum>
std::string choices_text() {
  std::string text;
  for (const Enum choice : choices<Enum>()) {
    const std::string_view name = enumerators<Enum>[static_cast<std::size_t>(choice)];
    const std::string meaning = header_text(declared_name<Enum>(), name);
    if (meaning.empty()) continue;
    text += (text.empty() ? "`" : "; `") + spelling(choice) + "`: " + meaning;
  }
  return text.empty() ? "" : text + ".";
}

template <class M>
struct Given {
  using Type = M;
};
template <class M>
struct Given<std::optional<M>> {
  using Type = M;
};

/// The text, and the values of the type if it is an enumeration, or an optional one.
template <class M>
std::string with_choices(const std::string& text) {
  using Type = typename Given<M>::Type;
  std::string values;
  if constexpr (std::is_enum_v<Type>) values = choices_text<Type>();
  return text + (text.empty() || values.empty() ? "" : " ") + values;
}

/// The docstring of a member. Throws std::logic_error if there is none.
template <class T, class M>
const char* member_doc(const Field<T, M>& field) {
  return docstring(with_choices<M>(comment_of<T>(field.declared)), Fields<T>::name, field.declared);
}

}  // namespace beeline::python
