#include "numpy_arrays.h"

#define NPY_NO_DEPRECATED_API NPY_1_22_API_VERSION
#define NPY_TARGET_VERSION NPY_1_22_API_VERSION
#include <algorithm>
#include <cstdint>
#include <vector>

#include <beeline/error.h>

#include "interruption.h"

#include <numpy/arrayobject.h>

namespace beeline::python {
namespace {

static_assert(sizeof(npy_intp) == sizeof(Index));

template <class T>
constexpr int type_number = NPY_FLOAT64;
template <>
constexpr int type_number<float> = NPY_FLOAT32;
template <>
constexpr int type_number<std::uint8_t> = NPY_UINT8;

int number_of(Real real) { return real == Real::float32 ? NPY_FLOAT32 : NPY_FLOAT64; }

PyArrayObject* array_of(nb::handle object) {
  return reinterpret_cast<PyArrayObject*>(object.ptr());
}

std::span<const Index> shape_of(PyArrayObject* array) {
  return {PyArray_DIMS(array), static_cast<std::size_t>(PyArray_NDIM(array))};
}

PyObject* checked(PyObject* object) {
  if (!object) throw nb::python_error();
  return object;
}

/// Raises numpy's error as a TypeError that begins with the argument's name.
[[noreturn]] void raise_conversion(const char* name) {
  nb::python_error error;
  if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw error;
  throw nb::type_error((std::string(name) + ": " + nb::str(error.value()).c_str()).c_str());
}

/// A contiguous array of the type; null with Python's error where there is none.
PyObject* converted(nb::handle value, int type) {
  const EndDelay delay;
  constexpr int flags = NPY_ARRAY_C_CONTIGUOUS | NPY_ARRAY_ALIGNED | NPY_ARRAY_NOTSWAPPED;
  return PyArray_FROMANY(value.ptr(), type, 0, 0, flags);
}

PyObject* swapped(PyArrayObject* array) {
  const int n = PyArray_NDIM(array);
  std::vector<npy_intp> axes(n);
  for (int i = 0; i < n; ++i) axes[i] = i;
  std::swap(axes[n - 1], axes[n - 2]);
  PyArray_Dims order{axes.data(), n};
  return checked(PyArray_Transpose(array, &order));
}

/// Whether results can be written to the array's memory as they are computed.
bool holds_directly(PyArrayObject* array, bool transposed) {
  if (!transposed) return PyArray_ISCARRAY(array);
  if (PyArray_NDIM(array) == 2) return PyArray_ISFARRAY(array);
  const nb::object exchanged = nb::steal(swapped(array));
  return PyArray_ISCARRAY(array_of(exchanged));
}

/// numpy takes the values below a mask without a word. Lists are those that it has read as numbers.
void refuse_masked(nb::handle value, const char* name) {
  if (is_list(value)) {
    for (const nb::handle item : nb::borrow(value)) {
      if (!PyFloat_CheckExact(item.ptr())) refuse_masked(item, name);
    }
  } else if (PyArray_Check(value.ptr()) && !PyArray_CheckExact(value.ptr()) &&
             nb::cast<bool>(nb::module_::import_("numpy.ma").attr("is_masked")(value))) {
    throw Error(std::string(name) + " has masked entries; fill or drop them");
  }
}

/// Whether the arrays share memory; also where finding out would take long.
bool share_memory(nb::handle a, nb::handle b) {
  try {
    const nb::object decide = nb::module_::import_("numpy").attr("shares_memory");
    return nb::cast<bool>(decide(a, b, nb::arg("max_work") = 100000));
  } catch (const nb::python_error& error) {
    if (!error.matches(PyExc_RuntimeError)) throw;
    return true;  // TooHardError
  }
}

/// The first byte of the array's memory and the one after its last.
std::pair<std::uintptr_t, std::uintptr_t> range_of(PyArrayObject* array) {
  const auto first = reinterpret_cast<std::uintptr_t>(PyArray_DATA(array));
  std::uintptr_t begin = first, end = first + static_cast<std::uintptr_t>(PyArray_ITEMSIZE(array));
  for (int i = 0; i < PyArray_NDIM(array); ++i) {
    const npy_intp length = (PyArray_DIM(array, i) - 1) * PyArray_STRIDE(array, i);
    (length < 0 ? begin : end) += static_cast<std::uintptr_t>(length);
  }
  return {begin, end};
}

/// The items of a list or tuple.
class Items {
 public:
  explicit Items(nb::handle list) : list_(list.ptr()), tuple_(PyTuple_Check(list.ptr())) {}
  std::size_t size() const {
    return static_cast<std::size_t>(tuple_ ? PyTuple_Size(list_) : PyList_Size(list_));
  }
  PyObject* operator[](std::size_t i) const {
    const auto k = static_cast<Py_ssize_t>(i);
    return tuple_ ? PyTuple_GetItem(list_, k) : PyList_GetItem(list_, k);
  }

 private:
  PyObject* list_;
  bool tuple_;
};

/// Reads a float, also one of numpy, or an int that numpy would read as one of its integers.
bool read_number(PyObject* item, double& number) {
  if (PyFloat_CheckExact(item) || Py_TYPE(item) == &PyDoubleArrType_Type) {
    number = PyFloat_AsDouble(item);
    return true;
  }
  if (!PyLong_CheckExact(item)) return false;
  int overflow = 0;
  number = static_cast<double>(PyLong_AsLongLongAndOverflow(item, &overflow));
  return overflow == 0;
}

}  // namespace

void import_numpy() {
  if (_import_array() < 0) throw nb::python_error();
}

bool is_array(nb::handle value) { return PyArray_Check(value.ptr()); }

bool is_list(nb::handle value) { return PyList_Check(value.ptr()) || PyTuple_Check(value.ptr()); }

bool FewNumbers::read_row(nb::handle row) {
  const Items items(row);
  if (size_ + items.size() > values_.size()) return false;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!read_number(items[i], values_[size_++])) return false;
  }
  return true;
}

bool FewNumbers::read(nb::handle value) {
  if (!is_list(value)) return false;
  const Items rows(value);
  if (rows.size() == 0) return false;
  rows_ = is_list(rows[0]);
  const std::size_t columns = Items(rows_ ? rows[0] : value.ptr()).size();
  shape_ = {static_cast<Index>(rows.size()), static_cast<Index>(columns)};
  if (columns == 0) return false;
  if (!rows_) return read_row(value);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!is_list(rows[i]) || Items(rows[i]).size() != columns || !read_row(rows[i])) return false;
  }
  return true;
}

InputArray::InputArray(nb::handle value, const char* name, bool float32)
    : name_(name), real_(Real::float64) {
  if (few_.read(value)) {
    dimensions_ = few_.dimensions();
    shape_ = few_.shape();
    data_ = few_.data();
    return;
  }
  if (value.is_none()) {
    throw nb::type_error((std::string(name) + ": expected numbers, not None").c_str());
  }
  int type = NPY_FLOAT64;
  if (PyArray_Check(value.ptr())) {
    refuse_masked(value, name);
    PyArrayObject* given = array_of(value);
    if (float32 && PyArray_TYPE(given) == NPY_FLOAT32) {
      type = NPY_FLOAT32;
      real_ = Real::float32;
    }
    if (PyArray_TYPE(given) == type && PyArray_ISCARRAY_RO(given)) {
      Py_INCREF(value.ptr());
      array_ = value.ptr();
    } else {
      array_ = converted(value, type);
    }
  } else {  // first as numpy sees it: text in lists would be read as numbers
    const nb::object natural = nb::steal(PyArray_FROM_O(value.ptr()));
    const bool numbers = natural.is_valid() && PyArray_TYPE(array_of(natural)) != NPY_OBJECT;
    if (numbers) refuse_masked(value, name);
    array_ = natural.is_valid() ? converted(natural, type) : nullptr;
  }
  if (!array_) raise_conversion(name);
  PyArrayObject* array = array_of(array_);
  dimensions_ = PyArray_NDIM(array);
  shape_ = PyArray_DIMS(array);
  data_ = PyArray_DATA(array);
}

Index InputArray::size() const { return rows(0); }

Index InputArray::rows(int inner) const {
  Index count = 1;
  for (int i = 0; i < dimensions_ - inner; ++i) count *= shape_[i];
  return count;
}

std::string shape_text(std::span<const Index> shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i ? ", " : "") + std::to_string(shape[i]);
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

NewArray::NewArray(std::span<const Index> shape, Real real)
    : object_(nb::steal(checked(
          PyArray_SimpleNew(static_cast<int>(shape.size()), shape.data(), number_of(real))))),
      data_(PyArray_DATA(array_of(object_))) {}

nb::object NewArray::release_transposed() { return nb::steal(swapped(array_of(object_))); }

nb::object NewArray::release_read_only() {
  PyArray_CLEARFLAGS(array_of(object_), NPY_ARRAY_WRITEABLE);
  return std::move(object_);
}

OutputArray::OutputArray(nb::handle value, const char* name, std::span<const Index> shape,
                         Real real, bool transposed) {
  if (!value.is_none()) {
    refuse_masked(value, name);
    if (!PyArray_Check(value.ptr()) || PyArray_TYPE(array_of(value)) != number_of(real)) {
      throw nb::type_error((std::string(name) + ": expected an array of " +
                            (real == Real::float32 ? "float32" : "float64"))
                               .c_str());
    }
    PyArrayObject* given = array_of(value);
    if (!std::ranges::equal(shape_of(given), shape)) {
      throw Error(std::string(name) + " has the shape " + shape_text(shape_of(given)) +
                  "; expected " + shape_text(shape));
    }
    if (!PyArray_ISWRITEABLE(given)) throw Error(std::string(name) + " is read-only");
    result_ = nb::borrow(value);
    if (holds_directly(given, transposed)) {
      data_ = PyArray_DATA(given);
      return;
    }
  }
  if (transposed && shape.size() == 2) {
    written_ =
        nb::steal(checked(PyArray_EMPTY(2, shape.data(), number_of(real), 1)));  // in Fortran order
    data_ = PyArray_DATA(array_of(written_));
    return;
  }
  std::vector<Index> memory(shape.begin(), shape.end());
  if (transposed) std::swap(memory[memory.size() - 1], memory[memory.size() - 2]);
  NewArray fresh(memory, real);
  data_ = fresh.data<void>();
  written_ = transposed ? fresh.release_transposed() : fresh.release();
}

nb::object OutputArray::finish() {
  if (!result_.is_valid()) return std::move(written_);
  const EndDelay delay;
  if (written_.is_valid() && PyArray_CopyInto(array_of(result_), array_of(written_)) < 0) {
    throw nb::python_error();
  }
  return std::move(result_);
}

void check_apart(nb::handle out, nb::handle argument, const char* name) {
  if (!PyArray_Check(out.ptr()) || !PyArray_Check(argument.ptr())) return;
  if (PyArray_SIZE(array_of(out)) == 0 || PyArray_SIZE(array_of(argument)) == 0) return;
  const auto [out_begin, out_end] = range_of(array_of(out));
  const auto [begin, end] = range_of(array_of(argument));
  if (out_end <= begin || end <= out_begin) return;
  if (!share_memory(out, argument)) return;  // columns of one table, say
  throw Error(std::string("out has memory of ") + name + "; give it its own");
}

nb::object read_only(nb::object value) {
  if (PyArray_Check(value.ptr())) PyArray_CLEARFLAGS(array_of(value), NPY_ARRAY_WRITEABLE);
  return value;
}

template <class T>
nb::object new_array(std::span<const Index> shape) {
  return nb::steal(
      checked(PyArray_SimpleNew(static_cast<int>(shape.size()), shape.data(), type_number<T>)));
}
template nb::object new_array<double>(std::span<const Index>);
template nb::object new_array<float>(std::span<const Index>);
template nb::object new_array<std::uint8_t>(std::span<const Index>);

template <class T>
nb::object contiguous_array(nb::handle value, const char* name) {
  if (!PyArray_Check(value.ptr()) || PyArray_TYPE(array_of(value)) != type_number<T>) {
    throw nb::type_error((std::string(name) + ": expected an array of " + dtype_name<T>).c_str());
  }
  refuse_masked(value, name);
  const nb::object array = nb::steal(checked(converted(value, type_number<T>)));
  return nb::steal(checked(PyArray_View(array_of(array), nullptr, nullptr)));
}
template nb::object contiguous_array<double>(nb::handle, const char*);
template nb::object contiguous_array<float>(nb::handle, const char*);
template nb::object contiguous_array<std::uint8_t>(nb::handle, const char*);

void* memory_of(nb::handle array) { return PyArray_DATA(array_of(array)); }

std::span<const Index> shape_of(nb::handle array) { return shape_of(array_of(array)); }

nb::object index_array(std::span<const std::size_t> values) {
  const npy_intp size = static_cast<npy_intp>(values.size());
  nb::object array = nb::steal(checked(PyArray_SimpleNew(1, &size, NPY_INT64)));
  std::ranges::copy(values, static_cast<std::int64_t*>(PyArray_DATA(array_of(array))));
  return read_only(array);
}

}  // namespace beeline::python
