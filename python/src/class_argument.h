#pragma once

#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>

/// Arguments of the module's classes. nanobind answers an object of another class with the
/// signature of the function; define() accepts any object and refuses it by one line instead.

namespace beeline::python {
namespace nb = nanobind;

/// The types of a function's parameters.
template <class R, class... P>
std::tuple<P...> parameters(R (*)(P...));
template <class F, class R, class... P>
std::tuple<P...> parameters(R (F::*)(P...) const);
template <class F, class R, class... P>
std::tuple<P...> parameters(R (F::*)(P...));

template <class Function>
auto parameters_of() {
  if constexpr (std::is_class_v<Function>) {
    return std::type_identity<decltype(parameters(&Function::operator()))>();
  } else {
    return std::type_identity<decltype(parameters(std::declval<Function>()))>();
  }
}

/// Throws TypeError: the argument, the class that it needs, what it is, and how to make one.
[[noreturn]] void raise_class(const char* name, nb::handle type, nb::handle value);

/// The object of the class that the argument is.
template <class T>
const T& object_of(nb::handle value, const char* name) {
  const T* found = nullptr;
  if (nb::try_cast<const T*>(value, found) && found != nullptr) return *found;
  raise_class(name, nb::type<T>(), value);
}

/// Whether a parameter is an object of a class of the module.
template <class P>
inline constexpr bool is_object =
    std::is_lvalue_reference_v<P>&& std::is_const_v<std::remove_reference_t<P>>&&
        nb::detail::is_base_caster_v<nb::detail::make_caster<P>>;

/// The parameter that nanobind sees: any object in place of one of a class.
template <class P, bool keep>
using Accepted = std::conditional_t<is_object<P> && !keep, nb::handle, P>;

template <class P, bool keep>
decltype(auto) given(std::remove_reference_t<Accepted<P, keep>>& value, const char* name) {
  if constexpr (is_object<P> && !keep) {
    return object_of<std::remove_cvref_t<P>>(value, name);
  } else {
    return static_cast<P&&>(value);
  }
}

template <std::size_t unnamed, class Function, class... P, std::size_t... I>
auto naming(Function function, const char* const* names, std::type_identity<std::tuple<P...>>,
            std::index_sequence<I...>) {
  return [function, names](Accepted<P, (I < unnamed)>... values) {
    return function(given<P, (I < unnamed)>(values, I < unnamed ? "" : names[I - unnamed])...);
  };
}

/// Keeps the names of a function's arguments for the life of the process.
const char* const* kept_names(std::vector<const char*> names);

template <class Argument>
void add_name(const Argument& argument, std::vector<const char*>& names) {
  if constexpr (nb::detail::arg_traits<Argument>::is_arg) names.push_back(argument.name_);
}

/// The function with parameters that accept any object in place of one of a class; `self`, which
/// has no nb::arg, excepted. A function without nb::arg stays as it is.
template <class Function, class... Extra>
auto naming_arguments(Function function, const Extra&... extra) {
  using Parameters = typename decltype(parameters_of<Function>())::type;
  constexpr std::size_t count = std::tuple_size_v<Parameters>;
  constexpr std::size_t named =
      (std::size_t{0} + ... + (nb::detail::arg_traits<Extra>::is_arg ? 1 : 0));
  if constexpr (named == 0 || named > count) {
    return function;
  } else {
    std::vector<const char*> names;
    (add_name(extra, names), ...);
    return naming<count - named>(function, kept_names(std::move(names)),
                                 std::type_identity<Parameters>(),
                                 std::make_index_sequence<count>());
  }
}

}  // namespace beeline::python
