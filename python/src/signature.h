#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include <beeline/budget.h>

#include "call_arguments.h"
#include "fields.h"

namespace beeline::python {

/// Keeps a text for the life of the process, as nanobind needs.
const char* kept_text(std::string text);

/// The signature of an attribute, for nanobind.
inline auto getter(const std::string& name, const std::string& type) {
  return nb::for_getter(nb::sig(kept_text("def " + name + "(self) -> " + type)));
}

/// Adds __copy__ and __deepcopy__: copy(self).
template <class T, class Copy>
void bind_copy(nb::class_<T>& bound, const std::string& name, Copy copy) {
  bound.def(
      "__copy__", [copy](nb::handle_t<T> self) { return copy(self); },
      nb::sig(kept_text("def __copy__(self) -> " + name)));
  bound.def(
      "__deepcopy__", [copy](nb::handle_t<T> self, nb::handle) { return copy(self); },
      nb::sig(kept_text("def __deepcopy__(self, memo: object, /) -> " + name)));
}

/// The copy of an object that never changes.
inline nb::object itself(nb::handle self) { return nb::borrow(self); }

/// A value as Python source; `...` for one that is not plain.
std::string source_of(nb::handle value);

/// The tuple of all members, in record.h.
template <class T>
nb::tuple state_of(const T& value);
template <class M>
std::string default_text(const M& value) {
  if constexpr (requires { Fields<M>::as_tuple; }) {
    return source_of(state_of(value));
  } else {
    return source_of(Value<M>::to(value));
  }
}

/// Whether a computation with these options calls `progress`; else that is no keyword of it.
template <class Options>
constexpr bool reports = true;

/// The annotation of arms in arguments, and the documentation of the argument `arm`.
inline constexpr const char* arm_like = "Arm | str";
inline constexpr const char* arm_doc = "The arm, or the name of a built-in one.";

/// The signature and the docstring, in numpydoc's form, of a function.
///
/// The section "Raises" names the arguments by their types: arrays may have another shape, a
/// trajectory may not fit the arm, other values may not be those described. What else is refused is
/// the summary's last sentence, `Raises Error for ...` or `Raises FileError, ...`.
class Signature {
 public:
  Signature(std::string name, std::string returns, std::string summary);

  /// Adds a parameter. Without `fallback` it is required.
  Signature& takes(const std::string& name, const std::string& type = "",
                   const std::string& doc = "", const std::string& fallback = "");
  /// Adds the parameter `arm`.
  Signature& takes_arm() { return takes("arm", arm_like, arm_doc); }
  /// Adds a parameter that sets a member of a struct, with its comment and default.
  template <auto Member>
  Signature& member() {
    using T = decltype(struct_of(Member));
    option(T{}, field<Member>(Member), false);
    return *this;
  }
  /// The parameters that follow are keywords.
  Signature& keywords();
  /// Adds a keyword for each field.
  template <class Options>
  Signature& options() {
    keywords();
    return members<Options>();
  }
  /// Adds a parameter for each field; keywords unless the struct takes_positions.
  template <class T>
  Signature& members() {
    if (!takes_positions<T>) keywords();
    const T defaults{};
    std::size_t i = 0;
    std::apply(
        [&](const auto&... field) { (option(defaults, field, i++ < required_members<T>), ...); },
        Fields<T>::all());
    return *this;
  }
  /// The keyword `progress`, which options() has with a budget.
  Signature& progress();
  /// Adds a parameter with the names of an enumeration, and what the header says of them.
  template <class Enum>
  Signature& choice(const std::string& name, const std::string& doc,
                    const std::string& fallback = "") {
    return takes(name, Value<Enum>::type(), with_choices<Enum>(doc), fallback);
  }
  /// What is returned, in one sentence.
  Signature& returns(std::string doc);
  /// Any numbers are accepted, finite or not: arguments are refused for their shapes only.
  Signature& any_values();
  /// The summary says which trajectories are refused: the section "Raises" adds nothing of them.
  Signature& summary_has_motions();

  /// Another function of the name follows, which takes the calls that do not fit this one.
  Signature& overloaded() {
    overloaded_ = true;
    return *this;
  }
  bool is_overloaded() const { return overloaded_; }

  /// The signature of the method of Arm: the first parameter, `arm`, is self.
  Signature of_arm() const;

  const char* name() const { return name_.c_str(); }
  /// The names of the parameters, without self.
  const std::vector<std::string>& parameters() const { return names_; }
  /// The signature as Python source, below a decorator where one is given.
  const char* text(const char* decorator = nullptr) const;
  const char* doc() const;

 private:
  template <class T, class M>
  void option(const T& defaults, const Field<T, M>& field, bool required) {
    if constexpr (std::is_same_v<M, Budget>) {
      budget(reports<T>);
    } else {
      std::string fallback;
      if (!required) fallback = default_text(defaults.*field.member);
      takes(field.name, argument_type<M>(), member_doc(field), fallback);
    }
  }
  void budget(bool reports);
  void refuses(const std::string& name, const std::string& type);
  std::string raised() const;

  std::string name_, returns_, summary_, returned_, parameters_, documented_, refused_;
  std::vector<std::string> names_;
  std::string arrays_, outputs_, files_, values_,
      motions_;  ///< names of parameters that may be refused
  bool keywords_ = false, any_values_ = false, has_arm_ = false, summary_has_motions_ = false;
  bool overloaded_ = false;
};

/// Adds a function or method whose signature and docstring `signature` gives. An object of another
/// class than a parameter's, a missing argument, too many and an unknown one are refused by a line
/// that names the argument.
template <class Scope, class Function, class... Extra>
void define(Scope& scope, Function function, const Signature& signature, const Extra&... extra) {
  const auto add = [&](const auto& call, const auto&... annotations) {
    scope.def(signature.name(), call, annotations..., nb::sig(signature.text()), signature.doc());
  };
  const bool constructs = std::string_view(signature.name()) == "__init__";
  const std::string name = constructs ? nb::str(scope.attr("__name__")).c_str() : signature.name();
  add_strict(add, name, signature.parameters(), signature.is_overloaded(), function, extra...);
}

/// Adds a static method.
template <class T, class Function, class... Extra>
void define_static(nb::class_<T>& scope, Function function, const Signature& signature,
                   const Extra&... extra) {
  const auto add = [&](const auto& call, const auto&... annotations) {
    scope.def_static(signature.name(), call, annotations...,
                     nb::sig(signature.text("staticmethod")), signature.doc());
  };
  add_strict(add, signature.name(), signature.parameters(), signature.is_overloaded(), function,
             extra...);
}

/// Adds a function whose first parameter is the arm, and a method of Arm that does the same.
template <class Function, class First, class... Extra>
void define_on_arm(nb::module_& m, Function function, const Signature& signature, const First& arm,
                   const Extra&... extra) {
  define(m, function, signature, arm, extra...);
  auto type = nb::borrow<nb::class_<Arm>>(m.attr("Arm"));
  define(type, function, signature.of_arm(), extra...);
}

/// Sets the part of the budget that the keyword names; returns whether there is one.
bool set_budget(Budget& budget, const std::string& keyword, nb::handle value);

/// The options of a computation that has no others than its budget.
struct BudgetOptions {
  Budget budget;
};
template <>
inline constexpr bool reports<BudgetOptions> = false;
template <>
struct Fields<BudgetOptions> : Members<&BudgetOptions::budget> {};

/// Sets the member of `result` that the keyword names; returns whether there is one.
template <class Options>
bool set_option(Options& result, const std::string& keyword, nb::handle value) {
  const auto assign = [&]<class M>(const Field<Options, M>& field) {
    if constexpr (std::is_same_v<M, Budget>) {
      if (keyword == "progress" && !reports<Options>) return false;
      return set_budget(result.*field.member, keyword, value);
    } else {
      if (keyword != field.name) return false;
      result.*field.member = Value<M>::from(value, field.name);
      return true;
    }
  };
  return std::apply([&](const auto&... field) { return (assign(field) || ...); },
                    Fields<Options>::all());
}

/// Adds the names of the members that set_option() knows.
template <class Options>
void add_option_names(std::vector<std::string>& names) {
  const auto add = [&]<class M>(const Field<Options, M>& field) {
    if constexpr (std::is_same_v<M, Budget>) {
      names.insert(names.end(), {"time_limit", "max_work"});
      if (reports<Options>) names.emplace_back("progress");
    } else {
      names.emplace_back(field.name);
    }
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, Fields<Options>::all());
}

/// The struct, or the tuple of structs, with the members that the keyword arguments name. Throws
/// TypeError, listing the options, for another name.
template <class... Options>
auto options(const nb::kwargs& values) {
  std::tuple<Options...> result{};
  for (const auto& item : values) {
    const std::string keyword = Value<std::string>::from(item.first, "keyword");
    const nb::handle value = item.second;
    const bool found = std::apply(
        [&](Options&... part) { return (set_option(part, keyword, value) || ...); }, result);
    if (found) continue;
    std::vector<std::string> names;
    (add_option_names<Options>(names), ...);
    throw nb::type_error(unknown_name("option", keyword, names).what());
  }
  if constexpr (sizeof...(Options) == 1) {
    return std::get<0>(std::move(result));
  } else {
    return result;
  }
}

}  // namespace beeline::python
