#pragma once

#include <string>
#include <tuple>

#include <beeline/budget.h>

#include "value.h"

namespace beeline::python {

/// One public member of a struct: its name in C++ and in Python, and its meaning.
template <class T, class M>
struct Field {
  const char* name;
  M T::*member;
  const char* doc;
};
template <class T, class M>
constexpr Field<T, M> field(const char* name, M T::*member, const char* doc) {
  return {name, member, doc};
}

/// Describes a struct once, for its Python class, for keyword arguments, signatures and docstrings:
/// `name`, `doc`, `all()`, a tuple of Field; where users make such objects, `constructible`, by
/// keywords, or `required`, the number of members that must be given, by position too; `as_tuple`
/// where an argument may be the tuple of its members;
/// `truth`, the meaning of its truth value, where it has one; `check`, a function that throws for
/// values that such an object cannot have. A member of type Budget stands for the keywords
/// time_limit, max_work and progress.
template <class T>
struct Fields;

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

template <class T>
struct MemberType;
template <class T, class M>
struct MemberType<Field<T, M>> {
  using type = M;
};
/// The type of the member that a field describes.
template <class F>
using member_type = typename MemberType<std::decay_t<F>>::type;

/// Keeps a text for the life of the process, as nanobind needs.
const char* kept_text(std::string text);

/// The default of an option as Python source; `...` for one that is not a plain value.
std::string default_text(nb::handle value);

/// The signature and the docstring, in numpydoc's form, of a function.
class Signature {
 public:
  Signature(std::string name, std::string returns, std::string summary);

  /// Adds a parameter. Without `fallback` it is required.
  Signature& takes(const std::string& name, const std::string& type = "",
                   const std::string& doc = "", const std::string& fallback = "");
  /// The parameters that follow are keywords.
  Signature& keywords();
  /// Adds a keyword for each field.
  template <class Options>
  Signature& options() {
    keywords();
    return members<Options>();
  }
  /// Adds a parameter for each field; keywords unless the struct has `required` members.
  template <class T>
  Signature& members() {
    if (required_members<T> == 0) keywords();
    const T defaults{};
    std::size_t i = 0;
    std::apply(
        [&](const auto&... field) { (option(defaults, field, i++ < required_members<T>), ...); },
        Fields<T>::all());
    return *this;
  }
  /// What is returned, in one sentence; and what is raised besides Error for invalid arguments.
  Signature& returns(std::string doc);

  const char* name() const { return name_.c_str(); }
  /// The signature as Python source, below a decorator where one is given.
  const char* text(const char* decorator = nullptr) const;
  const char* doc() const;

 private:
  template <class T, class M>
  void option(const T& defaults, const Field<T, M>& field, bool required) {
    if constexpr (std::is_same_v<M, Budget>) {
      budget();
    } else {
      takes(field.name, argument_type<M>(), field.doc,
            required ? "" : default_text(Value<M>::to(defaults.*field.member)));
    }
  }
  void budget();

  std::string name_, returns_, summary_, returned_, parameters_, documented_;
  bool keywords_ = false;
};

/// Adds a function, method or static method whose signature and docstring `signature` gives.
template <class Scope, class Function, class... Extra>
void define(Scope& scope, Function function, const Signature& signature, const Extra&... extra) {
  scope.def(signature.name(), function, extra..., nb::sig(signature.text()), signature.doc());
}

/// Sets the part of the budget that the keyword names; returns whether there is one.
bool set_budget(Budget& budget, const std::string& keyword, nb::handle value);

/// The options of a computation that has no others than its budget.
struct BudgetOptions {
  Budget budget;
};
template <>
struct Fields<BudgetOptions> {
  static constexpr const char* name = "BudgetOptions";
  static constexpr auto all() { return std::tuple(field("budget", &BudgetOptions::budget, "")); }
};

template <>
inline std::vector<Ending> choices() {
  return {Ending::complete, Ending::time_limit, Ending::cancelled, Ending::work_limit};
}

/// Sets the member of `result` that the keyword names; returns whether there is one. Adds the names
/// of all members to `names`.
template <class Options>
bool set_option(Options& result, const std::string& keyword, nb::handle value,
                std::vector<std::string>& names) {
  bool found = false;
  const auto assign = [&]<class M>(const Field<Options, M>& field) {
    if constexpr (std::is_same_v<M, Budget>) {
      found = found || set_budget(result.*field.member, keyword, value);
      names.insert(names.end(), {"time_limit", "max_work", "progress"});
    } else {
      names.emplace_back(field.name);
      if (keyword != field.name) return;
      result.*field.member = Value<M>::from(value, field.name);
      found = true;
    }
  };
  std::apply([&](const auto&... field) { (assign(field), ...); }, Fields<Options>::all());
  return found;
}

/// The struct, or the tuple of structs, with the members that the keyword arguments name. Throws
/// Error, listing the options, for another name.
template <class... Options>
auto options(const nb::kwargs& values) {
  std::tuple<Options...> result{};
  for (const auto& item : values) {
    const std::string keyword = Value<std::string>::from(item.first, "keyword");
    const nb::handle value = item.second;
    std::vector<std::string> names;
    const bool found = std::apply(
        [&](Options&... part) { return (set_option(part, keyword, value, names) || ...); }, result);
    if (!found) throw unknown_name("option", keyword, names);
  }
  if constexpr (sizeof...(Options) == 1) {
    return std::get<0>(std::move(result));
  } else {
    return result;
  }
}

}  // namespace beeline::python
