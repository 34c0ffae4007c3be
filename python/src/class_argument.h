#pragma once

#include <tuple>
#include <type_traits>
#include <utility>

#include <beeline/model/arm.h>

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

/// The arm that the object is, or the built-in arm that the text names; null for another object and
/// for a path or a joint string. An arm of a name is made once and kept. Throws Error, which
/// suggests a name, for any other text.
const Arm* arm_of(nb::handle value);

/// The object of the class that the argument is.
template <class T>
const T& object_of(nb::handle value, const char* name) {
  const T* found = nullptr;
  if constexpr (std::is_same_v<T, Arm>) {
    found = arm_of(value);
  } else {
    if (!nb::try_cast<const T*>(value, found)) found = nullptr;
  }
  if (found != nullptr) return *found;
  raise_class(name, nb::type<T>(), value);
}

/// Whether a parameter is an object of a class of the module.
template <class P>
inline constexpr bool is_object =
    std::is_lvalue_reference_v<P>&& std::is_const_v<std::remove_reference_t<P>>&&
        nb::detail::is_base_caster_v<nb::detail::make_caster<P>>;

/// Whether the argument is of the class that its parameter needs, if that is one of the module's.
template <class P, class Value>
bool is_of_class(const Value& value) {
  if constexpr (is_object<P> && std::is_same_v<Value, nb::handle>) {
    using T = std::remove_cvref_t<P>;
    return nb::isinstance<T>(value) || (std::is_same_v<T, Arm> && nb::isinstance<nb::str>(value));
  } else {
    return true;
  }
}

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

}  // namespace beeline::python
