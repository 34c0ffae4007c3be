#pragma once

#include "value.h"

namespace beeline::python {

/// A C-contiguous numpy array of double, float or std::uint8_t, kept as it is.
template <class T>
struct KeptArray {
  nb::object array;

  std::span<const Index> shape() const { return shape_of(array); }
  Index size() const {
    Index count = 1;
    for (Index n : shape()) count *= n;
    return count;
  }
  T* data() const { return static_cast<T*>(memory_of(array)); }
};

/// A new one, of values that are not set.
template <class T>
KeptArray<T> kept_array(std::span<const Index> shape) {
  return {new_array<T>(shape)};
}

template <class T>
struct Value<KeptArray<T>> {
  static std::string type() {
    return std::string("numpy.typing.NDArray[numpy.") + dtype_name<T> + "]";
  }
  static std::string argument_type() { return type(); }
  static nb::object to(const KeptArray<T>& value) { return value.array; }
  static KeptArray<T> from(nb::handle value, const char* name) {
    return {contiguous_array<T>(value, name)};
  }
  static bool same(const KeptArray<T>& a, const KeptArray<T>& b) {
    const nb::object equal = nb::module_::import_("numpy").attr("array_equal");
    return nb::cast<bool>(equal(a.array, b.array, nb::arg("equal_nan") = true));
  }
};

}  // namespace beeline::python
