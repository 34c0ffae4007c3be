#pragma once

#include <concepts>
#include <sstream>
#include <string_view>
#include <tuple>

#include <beeline/trajectory/trajectory.h>

#include "signature.h"

namespace beeline::python {

/// Whether a result has a trajectory, whose duration it then has too.
template <class T>
inline constexpr bool has_trajectory = requires(const T& result) {
  { result.trajectory } -> std::same_as<const Trajectory&>;
};

/// The value of a field as it appears in a repr(): whole, or its shape where it is a large array.
std::string field_text(nb::handle value);

/// Keeps `make()` under `name` in the attributes of `self`, so that it is computed once.
template <class Make>
nb::object kept(nb::handle self, const char* name, Make make) {
  nb::dict attributes = nb::borrow<nb::dict>(nb::getattr(self, "__dict__"));
  const nb::str key(name);
  if (attributes.contains(key)) return attributes[key];
  nb::object value = make();
  attributes[key] = value;
  return value;
}

template <class T>
inline constexpr bool is_constructible = requires {
  Fields<T>::constructible;
}
|| requires { Fields<T>::required; };

/// The struct of the values of its members: positional ones in their order where it
/// takes_positions, then keywords.
template <class T>
T made_record(const nb::args& values, const nb::kwargs& keywords) {
  constexpr std::size_t required = required_members<T>;
  std::vector<std::string> names;
  std::apply([&](const auto&... field) { (names.emplace_back(field.name), ...); },
             Fields<T>::all());
  const std::size_t positional = values.size();
  const std::size_t accepted = takes_positions<T> ? names.size() : 0;
  if (positional > accepted) {
    const std::string call = std::string(Fields<T>::name) + "()";
    throw nb::type_error((accepted == 0
                              ? call + " takes its values by name: " + listed(names)
                              : call + " takes at most " + std::to_string(accepted) + " values, " +
                                    listed(names) + ", not " + std::to_string(positional))
                             .c_str());
  }
  nb::kwargs named;
  for (std::size_t i = 0; i < positional; ++i) named[names[i].c_str()] = values[i];
  for (const auto& [key, value] : keywords) {
    if (named.contains(key)) {
      throw nb::type_error(
          (std::string(Fields<T>::name) + ": two values of " + nb::str(key).c_str()).c_str());
    }
    named[key] = value;
  }
  for (std::size_t i = 0; i < required; ++i) {
    if (named.contains(names[i].c_str())) continue;
    throw nb::type_error((std::string(Fields<T>::name) + ": " + names[i] + " is missing").c_str());
  }
  T made = options<T>(named);
  if constexpr (requires { Fields<T>::check(made); }) Fields<T>::check(made);
  return made;
}

/// Computes the members that the struct leaves until they are used.
template <class T>
const T& completed(const T& value) {
  // The objects of Python are not constants.
  if constexpr (requires(T & object) { Fields<T>::complete(object); }) {
    Fields<T>::complete(const_cast<T&>(value));
  }
  return value;
}

/// The same before the member `name` is read.
template <class T>
const T& completed(const T& value, std::string_view name) {
  if constexpr (requires { Fields<T>::is_left(name); }) {
    if (Fields<T>::is_left(name)) return completed(value);
  }
  return value;
}

/// A struct with Fields as a Python class: read-only attributes, no others, a constructor, repr(),
/// ==, copies and pickles.
template <class T>
requires is_described<T>
struct Value<T> {
  static std::string type() { return Fields<T>::name; }
  static std::string argument_type() {
    std::string text = Fields<T>::name;
    if constexpr (requires { Fields<T>::as_tuple; }) {
      std::string types;
      std::apply(
          [&](const auto&... field) {
            ((types +=
              (types.empty() ? "" : ", ") + python::argument_type<MemberType<decltype(field)>>()),
             ...);
          },
          Fields<T>::all());
      text += " | tuple[" + types + "]";
    }
    return text;
  }
  static nb::object to(const T& value) { return nb::cast(value); }
  static T from(nb::handle value, const char* name) {
    const T* found = nullptr;
    if (nb::try_cast<const T*>(value, found) && found) return *found;
    if constexpr (requires { Fields<T>::as_tuple; }) {
      if (nb::isinstance<nb::tuple>(value)) {
        return made_record<T>(nb::borrow<nb::args>(value), nb::kwargs());
      }
    }
    raise_type(name, argument_type(), value);
  }
  static bool same(const T& a, const T& b) {
    return std::apply(
        [&](const auto&... field) {
          return (python::same(completed(a).*field.member, completed(b).*field.member) && ...);
        },
        Fields<T>::all());
  }
};

template <class T, class M>
void bind_field(nb::class_<T>& bound, const Field<T, M>& field) {
  const auto sig = getter(field.name, Value<M>::type());
  const auto member = field.member;
  if constexpr (requires { Value<M>::large; } || is_described<M>) {
    const char* name = field.name;
    bound.def_prop_ro(
        field.name,
        [member, name](nb::handle_t<T> self) -> nb::object {
          if (!nb::inst_ready(self)) throw nb::type_error("the object was not initialised");
          const T* value = &completed(*nb::inst_ptr<T>(self), name);
          if constexpr (
              requires(T & left) { Fields<T>::complete(left); } &&
              requires(const M& list) { list.empty(); }) {
            if ((value->*member).empty())
              return Value<M>::to(value->*member);  // may be computed later
          }
          return kept(self, name, [&] { return Value<M>::to(value->*member); });
        },
        sig, member_doc(field));
  } else {
    bound.def_prop_ro(
        field.name,
        [member, name = field.name](const T& self) {
          return read_only(Value<M>::to(completed(self, name).*member));
        },
        sig, member_doc(field));
  }
}

/// Adds the members of a struct that get(object) returns, as read-only attributes.
template <class Part, class T, class Get>
void bind_part(nb::class_<T>& bound, Get get) {
  const auto add = [&]<class M>(const Field<Part, M>& field) {
    const auto member = field.member;
    bound.def_prop_ro(
        field.name, [member, get](const T& self) { return Value<M>::to(get(self).*member); },
        getter(field.name, Value<M>::type()), member_doc(field));
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, Fields<Part>::all());
}

/// Adds ==, by `same(a, b)`, of objects that have no hash.
template <class T, class Same>
void bind_equality(nb::class_<T>& bound, Same same) {
  bound.def(
      "__eq__",
      [same](const T& self, nb::handle other) -> nb::object {
        const T* right = nullptr;
        if (!nb::try_cast<const T*>(other, right) || !right) {
          return nb::borrow(nb::handle(Py_NotImplemented));
        }
        return nb::bool_(&self == right || same(self, *right));
      },
      nb::arg().none(), nb::sig("def __eq__(self, other: object, /) -> bool"));
  bound.attr("__hash__") = nb::none();
}

/// Adds repr(), with every member; str(), where C++ prints the struct or has a sentence() of it;
/// the truth value.
template <class T>
void bind_text(nb::class_<T>& bound) {
  using Described = Fields<T>;
  bound.def("__repr__", [](nb::handle_t<T> self) {
    std::string text = std::string(Described::name) + "(";
    std::apply(
        [&](const auto&... field) {
          std::size_t i = 0;
          ((text +=
            (i++ ? ", " : "") + std::string(field.name) + "=" + field_text(self.attr(field.name))),
           ...);
        },
        Described::all());
    return text + ")";
  });
  if constexpr (requires(std::ostream & out, const T& value) { out << value; }) {
    bound.def("__str__", [](const T& self) {
      std::ostringstream out;
      out << completed(self);
      return out.str();
    });
  } else if constexpr (requires(const T& value) { std::string(sentence(value)); }) {
    bound.def("__str__", [](const T& self) { return sentence(self); });
  }
  if constexpr (std::is_constructible_v<bool, T>) {
    bound.def(
        "__bool__", [](const T& self) { return static_cast<bool>(self); }, struct_doc<T>("bool"));
  }
}

/// The struct of the values that __getstate__ returned.
template <class T>
T restored(const nb::tuple& state) {
  constexpr std::size_t count = std::tuple_size_v<decltype(Fields<T>::all())>;
  if (nb::len(state) != count) throw Error("the pickled state has another number of values");
  T result;
  std::apply(
      [&](const auto&... field) {
        std::size_t i = 0;
        ((result.*field.member = Value<MemberType<decltype(field)>>::from(state[i++], field.name)),
         ...);
      },
      Fields<T>::all());
  if constexpr (requires { Fields<T>::check(result); }) Fields<T>::check(result);
  return result;
}

/// Which copies and pickles need.
template <class T>
nb::tuple state_of(const T& value) {
  return std::apply(
      [&](const auto&... field) {
        return nb::make_tuple(
            Value<MemberType<decltype(field)>>::to(completed(value).*field.member)...);
      },
      Fields<T>::all());
}

template <class T>
void bind_state(nb::class_<T>& bound) {
  bound.def(
      "__getstate__", [](const T& self) { return state_of(self); },
      nb::sig("def __getstate__(self) -> tuple[object, ...]"));
  bound.def(
      "__setstate__", [](T& self, const nb::tuple& state) { new (&self) T(restored<T>(state)); },
      nb::sig("def __setstate__(self, state: tuple[object, ...], /) -> None"));
}

/// Adds iteration over the members of a struct of numbers, and its conversion by numpy, to an array
/// of its own.
template <class T>
void bind_numbers(nb::class_<T> bound) {
  bound.def(
      "__iter__", [](const T& self) { return nb::iter(state_of(self)); },
      nb::sig("def __iter__(self) -> typing.Iterator[float]"));
  bound.def(
      "__array__",
      [](const T& self, nb::handle dtype, nb::handle copy) {
        if (!copy.is_none() && !nb::cast<bool>(copy)) {
          throw nb::value_error((std::string(Fields<T>::name) + " has no array to share").c_str());
        }
        return nb::module_::import_("numpy").attr("array")(
            state_of(self), dtype.is_none() ? nb::object(nb::str("float64")) : nb::borrow(dtype));
      },
      nb::arg("dtype") = nb::none(), nb::arg("copy") = nb::none(),
      nb::sig(
          (std::string("def __array__(self, dtype: object = None, copy: bool | None = None) -> ") +
           array_type)
              .c_str()));
}

/// `extra`: further annotations of the class, such as nb::pooled.
template <class T, class... Extra>
nb::class_<T> bind_record(nb::module_& module, const Extra&... extra) {
  using Described = Fields<T>;
  nb::class_<T> bound(module, Described::name, nb::dynamic_attr(), struct_doc<T>(), extra...);
  if constexpr (has_trajectory<T>) {
    bound.def_prop_ro(
        "duration", [](const T& self) { return self.trajectory.duration(); },
        getter("duration", "float"), "Of the trajectory, s; 0 without samples.");
  }
  std::apply([&](const auto&... field) { (bind_field(bound, field), ...); }, Described::all());
  if constexpr (is_constructible<T>) {
    Signature signature("__init__", "None", "Makes one from the values of its members.");
    signature.takes("self").template members<T>();
    if constexpr (!requires { Described::check; }) signature.any_values();
    define(
        bound,
        [](T* self, const nb::args& values, const nb::kwargs& keywords) {
          new (self) T(made_record<T>(values, keywords));
        },
        signature);
  }
  bound.def(
      "__setattr__",
      [](const T&, const std::string& member, nb::handle) {
        throw nb::attribute_error(
            (std::string(Described::name) + " is immutable: " + member + " cannot be set").c_str());
      },
      nb::sig("def __setattr__(self, name: str, value: object, /) -> None"));
  bind_text(bound);
  bind_equality(bound, &Value<T>::same);
  bind_state(bound);
  return bound;
}

}  // namespace beeline::python
