#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "class_argument.h"

/// Calls with a missing argument, too many, or an unknown keyword. nanobind answers them with the
/// signature of the function, over several lines; define() accepts them and refuses them by one
/// line instead. So each named parameter has a default, and each function takes further positional
/// and keyword arguments.

namespace beeline::python {

/// The names of a function and its parameters.
class CallNames {
 public:
  /// `known` are the documented parameters, `all` the ones that the call may name, in their order.
  /// `overloaded`: another function of the name follows, which takes calls that do not fit this
  /// one.
  CallNames(std::string function, std::vector<std::string> known, std::vector<const char*> all,
            bool overloaded)
      : function_(std::move(function)),
        known_(std::move(known)),
        all_(std::move(all)),
        overloaded_(overloaded) {}

  const char* name(std::size_t i) const { return all_[i]; }
  bool overloaded() const { return overloaded_; }
  [[noreturn]] void refuse_missing(std::size_t i) const;
  [[noreturn]] void refuse_positional(std::size_t accepted, std::size_t further) const;
  [[noreturn]] void refuse_keywords(const nb::kwargs& keywords) const;

 private:
  std::string function_;
  std::vector<std::string> known_;
  std::vector<const char*> all_;
  bool overloaded_ = false;
};

/// Keeps the names for the life of the process.
const CallNames* kept_names(CallNames names);

/// The default of a parameter that has none.
inline nb::object missing_argument() { return nb::borrow(Py_Ellipsis); }

template <class Extra>
inline constexpr bool is_argument = nb::detail::arg_traits<Extra>::is_arg;

template <class P>
inline constexpr bool is_keywords = std::is_same_v<std::remove_cvref_t<P>, nb::kwargs>;
template <class P>
inline constexpr bool is_positionals = std::is_same_v<std::remove_cvref_t<P>, nb::args>;

/// How the parameters P of a function are given, with the annotations Extra.
template <class Parameters, class... Extra>
struct CallShape;
template <class... P, class... Extra>
struct CallShape<std::tuple<P...>, Extra...> {
  using Parameters = std::tuple<P...>;
  static constexpr std::size_t count = sizeof...(P);
  /// Whether the function takes any keywords itself: its last parameter.
  static constexpr bool has_keywords = (is_keywords<P> || ... || false);
  /// Whether it checks its arguments itself.
  static constexpr bool has_positionals = (is_positionals<P> || ... || false);
  static constexpr std::size_t annotated = (std::size_t{0} + ... + (is_argument<Extra> ? 1 : 0));
  /// Parameters without a name: `self`.
  static constexpr std::size_t unnamed = count - annotated;
  static constexpr std::size_t named = annotated - (has_keywords ? 1 : 0);

  /// Annotations of arguments before the i-th one of all.
  static constexpr std::size_t arguments_before(std::size_t i) {
    constexpr std::array<bool, sizeof...(Extra) + 1> is{is_argument<Extra>..., false};
    std::size_t found = 0;
    for (std::size_t k = 0; k < i; ++k) found += is[k] ? 1 : 0;
    return found;
  }

  /// Named parameters that may be given by their position.
  static constexpr std::size_t positional_count() {
    constexpr std::array<bool, sizeof...(Extra) + 1> begins{std::is_same_v<Extra, nb::kw_only>...,
                                                            false};
    for (std::size_t i = 0; i < sizeof...(Extra); ++i) {
      if (begins[i]) return arguments_before(i);
    }
    return named;
  }
  static constexpr std::size_t positional = positional_count();
};

/// The annotation of a parameter, with a default. A handle may be None: the function's body refuses
/// it, naming the argument.
template <class Argument>
auto with_default(const Argument& argument) {
  using Traits = nb::detail::arg_traits<Argument>;
  constexpr auto flags = Traits::flags | nb::detail::cast_flags::accepts_none;
  if constexpr (Traits::has_default) {
    return nb::arg_v_t<flags, Traits::locked>(argument, nb::object(argument.value));
  } else {
    return nb::arg_v_t<flags, Traits::locked>(argument, missing_argument());
  }
}

/// The annotation as a tuple of one if it is of a named parameter with a number from `begin` on and
/// before `end`; else an empty one.
template <std::size_t begin, std::size_t end, std::size_t number, class Extra>
auto chosen(const Extra& extra) {
  if constexpr (is_argument<Extra> && number >= begin && number < end) {
    return std::tuple(with_default(extra));
  } else {
    return std::tuple<>();
  }
}

/// Calls `add` with the annotations of the function that strict_call() returns.
template <class Shape, class Add, class... Extra, std::size_t... I>
void with_annotations(const Add& add, std::index_sequence<I...>, const Extra&... extra) {
  std::apply(add, std::tuple_cat(
                      chosen<0, Shape::positional, Shape::arguments_before(I)>(extra)...,
                      std::tuple(nb::arg("args")),
                      chosen<Shape::positional, Shape::named, Shape::arguments_before(I)>(extra)...,
                      std::tuple(nb::arg("kwargs"))));
}

template <class Shape, std::size_t i>
using CallParameter = std::tuple_element_t<i, typename Shape::Parameters>;

/// Refuses a parameter whose default says that it is missing.
template <class Value>
void check_given(const Value& value, const CallNames& names, std::size_t i) {
  if constexpr (std::is_same_v<Value, nb::handle>) {
    if (value.ptr() == Py_Ellipsis) names.refuse_missing(i);
  }
}

/// The function with parameters that accept any object in place of one of a class, none at all, and
/// further arguments; it refuses them by one line. `self`, which has no nb::arg, stays.
template <class Shape, class Function, std::size_t... S, std::size_t... A, std::size_t... B>
auto strict_call(Function function, const CallNames* names, std::index_sequence<S...>,
                 std::index_sequence<A...>, std::index_sequence<B...>) {
  constexpr std::size_t unnamed = Shape::unnamed, split = Shape::positional;
  return [function, names](Accepted<CallParameter<Shape, S>, true>... self,
                           Accepted<CallParameter<Shape, unnamed + A>, false>... first,
                           const nb::args& others,
                           Accepted<CallParameter<Shape, unnamed + split + B>, false>... rest,
                           const nb::kwargs& keywords) {
    if (!others.empty()) names->refuse_positional(split, others.size());
    if (!Shape::has_keywords && !keywords.empty()) names->refuse_keywords(keywords);
    (check_given(first, *names, A), ...);
    (check_given(rest, *names, split + B), ...);
    if (names->overloaded() &&
        !((A > 0 || is_of_class<CallParameter<Shape, unnamed + A>>(first)) && ... && true)) {
      throw nb::next_overload();
    }
    const auto call = [&](auto&&... own) -> decltype(auto) {
      return function(
          given<CallParameter<Shape, S>, true>(self, "")...,
          given<CallParameter<Shape, unnamed + A>, false>(first, names->name(A))...,
          given<CallParameter<Shape, unnamed + split + B>, false>(rest, names->name(split + B))...,
          own...);
    };
    if constexpr (Shape::has_keywords) {
      return call(keywords);
    } else {
      return call();
    }
  };
}

/// Calls `add` with the function and its annotations.
template <class Add, class Function, class... Extra>
void add_strict(const Add& add, const std::string& name, const std::vector<std::string>& known,
                bool overloaded, Function function, const Extra&... extra) {
  using Parameters = typename decltype(parameters_of<Function>())::type;
  using Shape = CallShape<Parameters, Extra...>;
  if constexpr (Shape::has_positionals) {
    add(function, extra...);
  } else {
    std::vector<const char*> all;
    [[maybe_unused]] const auto add_name = [&all](const auto& argument) {
      if constexpr (is_argument<std::remove_cvref_t<decltype(argument)>>) {
        all.push_back(argument.name_);
      }
    };
    (add_name(extra), ...);
    const CallNames* names = kept_names({name, known, std::move(all), overloaded});
    const auto call =
        strict_call<Shape>(function, names, std::make_index_sequence<Shape::unnamed>(),
                           std::make_index_sequence<Shape::positional>(),
                           std::make_index_sequence<Shape::named - Shape::positional>());
    with_annotations<Shape>([&](const auto&... annotations) { add(call, annotations...); },
                            std::index_sequence_for<Extra...>(), extra...);
  }
}

}  // namespace beeline::python
