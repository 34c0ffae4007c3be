#include "value.h"

#include <algorithm>

#include <beeline/pose/se2.h>

namespace beeline::python {
namespace {

std::string name_of_type(nb::handle value) {
  return nb::str(nb::handle(reinterpret_cast<PyObject*>(Py_TYPE(value.ptr()))).attr("__name__"))
      .c_str();
}

[[noreturn]] void raise_shape(const InputArray& array, const char* expected) {
  throw Error(std::string(array.name()) + " has the shape " + shape_text(array.shape()) +
              "; expected " + expected);
}

bool is_array_or_list(nb::handle value) { return is_array(value) || is_list(value); }

}  // namespace

nb::object matrix_of(nb::handle value) {
  if (is_array_or_list(value)) return nb::borrow(value);
  for (const char* name : {"homogeneous", "A"}) {
    if (nb::hasattr(value, name)) return value.attr(name);
  }
  if (nb::hasattr(value, "as_matrix")) return value.attr("as_matrix")();
  return nb::borrow(value);
}

void raise_type(const char* name, const std::string& expected, nb::handle value) {
  throw nb::type_error(
      (std::string(name) + ": expected " + expected + ", not " + name_of_type(value)).c_str());
}

void refuse_former(nb::handle value, const char* former, const char* name) {
  if (value.is_none()) return;
  throw nb::type_error(("the keyword " + std::string(former) + " is called " + name).c_str());
}

std::string path_from(nb::handle path, const char* name) {
  if (path.is_none()) raise_type(name, "a path", path);
  const nb::object text = nb::steal(PyOS_FSPath(path.ptr()));
  if (!text.is_valid()) throw nb::python_error();
  std::string whole = Value<std::string>::from(text, name);
  // The system would end the path there, and mean another file.
  if (whole.find('\0') != std::string::npos)
    throw Error(std::string(name) + " contains a null byte");
  return whole;
}

double Value<double>::from(nb::handle value, const char* name) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (number == -1 && PyErr_Occurred()) {
    const nb::python_error error;
    if (error.matches(PyExc_TypeError)) raise_type(name, "a number", value);
    if (!error.matches(PyExc_OverflowError)) throw error;
    throw Error(std::string(name) + " is larger than a float");
  }
  return number;
}

bool Value<bool>::from(nb::handle value, const char* name) {
  if (value.ptr() == Py_True) return true;
  if (value.ptr() == Py_False) return false;
  if (name_of_type(value) == "bool" || name_of_type(value) == "bool_") {  // of numpy
    const int truth = PyObject_IsTrue(value.ptr());
    if (truth < 0) throw nb::python_error();
    return truth == 1;
  }
  raise_type(name, "True or False", value);
}

std::int64_t integer_from(nb::handle value, const char* name, std::int64_t min, std::int64_t max) {
  nb::object whole = nb::steal(PyNumber_Index(value.ptr()));
  if (!whole.is_valid()) {
    const nb::python_error error;
    if (error.matches(PyExc_TypeError)) raise_type(name, "a whole number", value);
    throw error;
  }
  const long long number = PyLong_AsLongLong(whole.ptr());
  const bool failed = number == -1 && PyErr_Occurred();
  if (failed) PyErr_Clear();
  if (failed || number < min || number > max) {
    throw Error(std::string(name) + " must be a whole number from " + std::to_string(min) + " to " +
                std::to_string(max));
  }
  return number;
}

std::string Value<std::string>::from(nb::handle value, const char* name) {
  if (!PyUnicode_Check(value.ptr())) raise_type(name, "text", value);
  Py_ssize_t size = 0;
  const char* text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
  if (!text) {
    PyErr_Clear();
    throw Error(std::string(name) + " is not valid text");
  }
  return {text, static_cast<std::size_t>(size)};
}

Pose pose_of(const double* rows) {
  Pose pose;
  pose.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows);
  return pose;
}

Pose pose_of(const InputArray& array) {
  if (array.dimensions() != 2 || array.shape()[0] != 4 || array.shape()[1] != 4) {
    const bool triple = array.dimensions() == 1 && array.shape()[0] == 3;
    raise_shape(array, triple ? "a pose (4, 4), which make_pose([x, y, z]) makes of a position"
                              : "a pose (4, 4), which pose_of() makes of numbers");
  }
  return pose_of(array.data());
}

void write_pose(const Pose& pose, double* rows) {
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(rows);
  matrix = pose.matrix();
}

nb::object Value<Pose>::to(const Pose& value) {
  NewArray array({4, 4});
  write_pose(value, array.data());
  return array.release();
}

Pose Value<Pose>::from(nb::handle value, const char* name) {
  if (nb::isinstance<Pose2>(value)) return checked_pose(to_space(nb::cast<Pose2>(value)), name);
  const nb::object matrix = matrix_of(value);
  return checked_pose(pose_of(InputArray(matrix, name)), name);
}

std::vector<Pose> poses_from(nb::handle value, const char* name) {
  std::vector<Pose> poses;
  if (is_list(value) && nb::len(value) > 0 && !is_array_or_list(value[0]) &&
      !PyNumber_Check(nb::object(value[0]).ptr())) {
    for (nb::handle item : nb::borrow(value)) poses.push_back(Value<Pose>::from(item, name));
    return poses;
  }
  const nb::object matrices = matrix_of(value);
  const InputArray array(matrices, name);
  const auto shape = array.shape();
  if (array.dimensions() == 1 && shape[0] == 0) return poses;
  if (array.dimensions() < 2 || array.dimensions() > 3 || shape[shape.size() - 1] != 4 ||
      shape[shape.size() - 2] != 4) {
    raise_shape(array, "poses (N, 4, 4)");
  }
  for (Index i = 0; i < array.rows(2); ++i) {
    poses.push_back(checked_pose(pose_of(array.data() + 16 * i), name));
  }
  return poses;
}

nb::object Value<std::vector<double>>::to(const std::vector<double>& value) {
  NewArray array({static_cast<Index>(value.size())});
  std::ranges::copy(value, array.data());
  return array.release_read_only();
}

std::vector<double> Value<std::vector<double>>::from(nb::handle value, const char* name) {
  const InputArray array(value, name);
  if (array.dimensions() != 1) raise_shape(array, "(N,)");
  return {array.data(), array.data() + array.size()};
}

bool Value<std::vector<double>>::same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return python::same(x, y); });
}

std::vector<std::size_t> Value<std::vector<std::size_t>>::from(nb::handle value, const char* name) {
  std::vector<std::size_t> indices;
  for (double index : Value<std::vector<double>>::from(value, name)) {
    if (!(index >= 0 && index < 9e15 && index == std::floor(index))) {
      throw Error(std::string(name) + ": " + number(index) + " is not an index");
    }
    indices.push_back(static_cast<std::size_t>(index));
  }
  return indices;
}

nb::object Value<std::vector<Configuration>>::to(const std::vector<Configuration>& value) {
  const Index columns = value.empty() ? 0 : value.front().size();
  NewArray array({static_cast<Index>(value.size()), columns});
  double* next = array.data();
  for (const Configuration& q : value) next = std::copy(q.begin(), q.end(), next);
  return array.release_read_only();
}

std::vector<Configuration> Value<std::vector<Configuration>>::from(nb::handle value,
                                                                   const char* name) {
  const InputArray array(value, name);
  std::vector<Configuration> rows;
  if (array.dimensions() == 1 && array.size() == 0) return rows;
  if (array.dimensions() != 2) raise_shape(array, "(N, n)");
  const Index n = array.shape()[1];
  for (Index i = 0; i < array.shape()[0]; ++i) {
    rows.emplace_back(Eigen::Map<const Configuration>(array.data() + i * n, n));
  }
  return rows;
}

bool Value<std::vector<Configuration>>::same(const std::vector<Configuration>& a,
                                             const std::vector<Configuration>& b) {
  return std::ranges::equal(a, b, Value<Configuration>::same);
}

nb::object Value<std::vector<Pose>>::to(const std::vector<Pose>& value) {
  NewArray array({static_cast<Index>(value.size()), 4, 4});
  for (std::size_t i = 0; i < value.size(); ++i) write_pose(value[i], array.data() + 16 * i);
  return array.release_read_only();
}

bool Value<std::vector<Pose>>::same(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  return std::ranges::equal(a, b, Value<Pose>::same);
}

nb::object Value<std::vector<bool>>::to(const std::vector<bool>& value) {
  nb::list list;
  for (const bool item : value) list.append(nb::bool_(item));
  return list;
}

std::vector<bool> Value<std::vector<bool>>::from(nb::handle value, const char* name) {
  if (nb::isinstance<nb::str>(value) || !PySequence_Check(value.ptr())) {
    raise_type(name, "a list of True and False", value);
  }
  std::vector<bool> items;
  for (nb::handle item : nb::iter(value)) items.push_back(Value<bool>::from(item, name));
  return items;
}

}  // namespace beeline::python
