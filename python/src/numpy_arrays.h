#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

#include <nanobind/nanobind.h>

namespace beeline::python {

namespace nb = nanobind;
using Index = Eigen::Index;

enum class Real { float64, float32 };

/// Imports numpy's C interface, when the module is imported. Throws the ImportError of Python.
void import_numpy();

/// Whether the object is a numpy array.
bool is_array(nb::handle value);
/// Whether the object is a list or a tuple.
bool is_list(nb::handle value);

/// The numbers of a list, or of a list of rows of equal length, read without numpy, which takes
/// several times as long for few.
class FewNumbers {
 public:
  /// Returns whether the object is such a list, of as many numbers as a pose has at most. Another
  /// one is left to numpy.
  bool read(nb::handle value);
  const double* data() const { return values_.data(); }
  int dimensions() const { return rows_ ? 2 : 1; }
  const Index* shape() const { return shape_.data(); }

 private:
  bool read_row(nb::handle row);
  std::array<double, 16> values_;
  std::size_t size_ = 0;
  std::array<Index, 2> shape_;  ///< without rows both are the length
  bool rows_ = false;
};

/// An argument as a C-contiguous array of float64, or of float32 where it is one and `float32` is
/// accepted. Refers to the caller's memory where its dtype and strides allow, else to a copy.
class InputArray {
 public:
  /// Takes arrays, lists, tuples and numbers. Throws TypeError, naming the argument, for all that
  /// numpy does not convert to float64 safely: text, objects, complex numbers, ragged lists. Throws
  /// Error for masked entries, whose values numpy would take.
  InputArray(nb::handle value, const char* name, bool float32 = false);
  InputArray(const InputArray&) = delete;
  InputArray& operator=(const InputArray&) = delete;
  ~InputArray() { Py_XDECREF(array_); }

  const char* name() const { return name_; }
  Real real() const { return real_; }
  std::span<const Index> shape() const { return {shape_, static_cast<std::size_t>(dimensions_)}; }
  int dimensions() const { return dimensions_; }
  Index size() const;
  template <class T = double>
  const T* data() const {
    return static_cast<const T*>(data_);
  }

  /// The product of all but the last `inner` dimensions: the number of rows of a batch.
  Index rows(int inner) const;

 private:
  FewNumbers few_;
  PyObject* array_ = nullptr;  ///< null: the numbers are in few_
  const char* name_;
  Real real_;
  int dimensions_;
  const Index* shape_;
  const void* data_;
};

/// `(3, 7)`, as Python writes a shape.
std::string shape_text(std::span<const Index> shape);

/// A new array, C-contiguous, whose values are not set.
class NewArray {
 public:
  explicit NewArray(std::span<const Index> shape, Real real = Real::float64);
  NewArray(std::initializer_list<Index> shape, Real real = Real::float64)
      : NewArray(std::span(shape.begin(), shape.size()), real) {}

  template <class T = double>
  T* data() const {
    return static_cast<T*>(data_);
  }
  nb::object release() { return std::move(object_); }

  /// The array seen with its last two dimensions exchanged, without a copy.
  nb::object release_transposed();

  /// The array, which can no longer be written to.
  nb::object release_read_only();

 private:
  nb::object object_;
  void* data_;
};

/// The caller's array for results: float64 (or float32), of this shape, writable, with any strides.
/// finish() copies the results into it where they could not be written there directly.
class OutputArray {
 public:
  /// `value` None: a new array. `transposed`: the memory holds the last two dimensions exchanged.
  /// The caller's memory may be written to before finish(): see check_apart(). Throws TypeError
  /// unless it is an array of the dtype, Error for another shape or a read-only one.
  OutputArray(nb::handle value, const char* name, std::span<const Index> shape, Real real,
              bool transposed = false);

  template <class T = double>
  T* data() const {
    return static_cast<T*>(data_);
  }
  nb::object finish();

 private:
  nb::object written_;  ///< has the memory that data() is
  nb::object result_;   ///< the caller's, or null: then `written_` is returned
  void* data_;
};

/// Throws Error where `out` has memory of the argument, both arrays: results are written while
/// arguments are read.
void check_apart(nb::handle out, nb::handle argument, const char* name);

/// Returns the value; an array can no longer be written to.
nb::object read_only(nb::object value);

/// numpy's name of a type of numbers: double, float or std::uint8_t.
template <class T>
inline constexpr const char* dtype_name = "float64";
template <>
inline constexpr const char* dtype_name<float> = "float32";
template <>
inline constexpr const char* dtype_name<std::uint8_t> = "uint8";

/// A new array of T, C-contiguous, whose values are not set.
template <class T>
nb::object new_array(std::span<const Index> shape);

/// An array of T as a C-contiguous one: a view of it, or a copy. Throws TypeError for all else.
template <class T>
nb::object contiguous_array(nb::handle value, const char* name);

/// The memory and the shape of an array.
void* memory_of(nb::handle array);
std::span<const Index> shape_of(nb::handle array);

/// The values as integers, for indices: a new array of int64 that cannot be written to.
nb::object index_array(std::span<const std::size_t> values);

}  // namespace beeline::python
