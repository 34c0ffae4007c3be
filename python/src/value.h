#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/kinematics/task.h>

#include "declared_names.h"
#include "numpy_arrays.h"

#include <nanobind/stl/string.h>

namespace beeline::python {

/// How a C++ type looks in Python: its annotation, and conversions both ways. from() names the
/// argument in the TypeError or Error that it throws. `large` values are converted once and kept.
template <class T>
struct Value;

/// The annotation of arrays in results, and of those in arguments.
inline constexpr const char* array_type = "numpy.typing.NDArray[numpy.float64]";
inline constexpr const char* array_like = "numpy.typing.ArrayLike";
/// What docstrings say of a pose.
inline constexpr const char* pose_doc = "Pose (4, 4).";

/// The annotation of paths, and a path as text: of a str or an os.PathLike.
inline constexpr const char* path_like = "str | os.PathLike[str]";
std::string path_from(nb::handle path, const char* name);

[[noreturn]] void raise_type(const char* name, const std::string& expected, nb::handle value);

/// Throws TypeError if a keyword is given by its former name.
void refuse_former(nb::handle value, const char* former, const char* name);

/// The annotation of an argument, which may be more than a result: any array, any sequence.
template <class T>
std::string argument_type() {
  if constexpr (requires { Value<T>::argument_type(); }) return Value<T>::argument_type();
  std::string type = Value<T>::type();
  if (type.starts_with("numpy.")) type = array_like;
  return type;
}

/// Equality as of records: NaN equals NaN.
inline bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
template <class T>
bool same(const T& a, const T& b) {
  return Value<T>::same(a, b);
}

template <>
struct Value<double> {
  static std::string type() { return "float"; }
  static nb::object to(double value) { return nb::float_(value); }
  static double from(nb::handle value, const char* name);
  static bool same(double a, double b) { return python::same(a, b); }
};

template <>
struct Value<bool> {
  static std::string type() { return "bool"; }
  static nb::object to(bool value) { return nb::bool_(value); }
  static bool from(nb::handle value, const char* name);
  static bool same(bool a, bool b) { return a == b; }
};

/// Whole numbers, within the range of the C++ type.
std::int64_t integer_from(nb::handle value, const char* name, std::int64_t min, std::int64_t max);
template <class T>
requires std::is_integral_v<T> &&(!std::is_same_v<T, bool>)struct Value<T> {
  static std::string type() { return "int"; }
  static nb::object to(T value) { return nb::int_(value); }
  static T from(nb::handle value, const char* name) {
    using Limits = std::numeric_limits<T>;
    constexpr std::int64_t max = sizeof(T) < 8 ? static_cast<std::int64_t>(Limits::max())
                                               : std::numeric_limits<std::int64_t>::max();
    return static_cast<T>(integer_from(value, name, static_cast<std::int64_t>(Limits::min()), max));
  }
  static bool same(T a, T b) { return a == b; }
};

template <>
struct Value<std::string> {
  static std::string type() { return "str"; }
  static nb::object to(const std::string& value) { return nb::str(value.data(), value.size()); }
  static std::string from(nb::handle value, const char* name);
  static bool same(const std::string& a, const std::string& b) { return a == b; }
};

/// An optional value is None when it is not set.
template <class T>
struct Value<std::optional<T>> {
  static std::string type() { return Value<T>::type() + " | None"; }
  static std::string argument_type() { return python::argument_type<T>() + " | None"; }
  static nb::object to(const std::optional<T>& value) {
    return value ? Value<T>::to(*value) : nb::none();
  }
  static std::optional<T> from(nb::handle value, const char* name) {
    if (value.is_none()) return std::nullopt;
    return Value<T>::from(value, name);
  }
  static bool same(const std::optional<T>& a, const std::optional<T>& b) {
    return a.has_value() == b.has_value() && (!a || python::same(*a, *b));
  }
};

/// Vectors and matrices of a fixed or free number of rows and columns. A vector has one dimension.
template <class Matrix>
requires std::is_base_of_v<Eigen::MatrixBase<Matrix>, Matrix>
struct Value<Matrix> {
  static constexpr bool vector = Matrix::ColsAtCompileTime == 1;
  static std::string type() { return array_type; }
  static nb::object to(const Matrix& value) {
    if constexpr (vector) {
      NewArray array({value.size()});
      Eigen::Map<Eigen::VectorXd>(array.data(), value.size()) = value;
      return array.release();
    } else {
      NewArray array({value.rows(), value.cols()});
      Eigen::Map<RowMajor>(array.data(), value.rows(), value.cols()) = value;
      return array.release();
    }
  }
  static Matrix from(nb::handle value, const char* name) {
    const InputArray array(value, name);
    const bool fits =
        array.dimensions() == (vector ? 1 : 2) &&
        (Matrix::RowsAtCompileTime < 0 || array.shape()[0] == Matrix::RowsAtCompileTime) &&
        (vector || Matrix::ColsAtCompileTime < 0 || array.shape()[1] == Matrix::ColsAtCompileTime);
    if (!fits) raise_shape(array, expected_shape());
    if constexpr (vector) {
      return Eigen::Map<const Matrix>(array.data(), array.size());
    } else {
      return Eigen::Map<const RowMajor>(array.data(), array.shape()[0], array.shape()[1]);
    }
  }
  static bool same(const Matrix& a, const Matrix& b) {
    if (a.rows() != b.rows() || a.cols() != b.cols()) return false;
    for (Index i = 0; i < a.size(); ++i) {
      if (!python::same(a.data()[i], b.data()[i])) return false;
    }
    return true;
  }

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  static std::string expected_shape() {
    const auto size = [](int n) { return n < 0 ? std::string("n") : std::to_string(n); };
    if constexpr (vector) return "(" + size(Matrix::RowsAtCompileTime) + ",)";
    return "(" + size(Matrix::RowsAtCompileTime) + ", " + size(Matrix::ColsAtCompileTime) + ")";
  }
  [[noreturn]] static void raise_shape(const InputArray& array, const std::string& expected) {
    throw Error(std::string(array.name()) + " has the shape " + shape_text(array.shape()) +
                "; expected " + expected);
  }
};

/// A vector or matrix of finite numbers.
template <class Matrix>
Matrix finite_from(nb::handle value, const char* name) {
  Matrix matrix = Value<Matrix>::from(value, name);
  if (!matrix.allFinite()) throw Error(std::string(name) + " has a value that is not finite");
  return matrix;
}

/// The matrix of a pose or rotation of another library, or the value itself.
nb::object matrix_of(nb::handle value);

/// Poses are 4 x 4 arrays. As arguments, also a Pose2, in the plane z = 0, and what has such a
/// matrix as `homogeneous` (pinocchio's SE3), `A` (spatialmath's SE3) or `as_matrix()` (scipy's
/// RigidTransform).
template <>
struct Value<Pose> {
  static std::string type() { return array_type; }
  static nb::object to(const Pose& value);
  static Pose from(nb::handle value, const char* name);
  static bool same(const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); }
};

/// The pose of a C-ordered 4 x 4 matrix.
Pose pose_of(const double* rows);
/// The same of an argument, whose values are not checked. Throws Error for another shape.
Pose pose_of(const InputArray& array);
void write_pose(const Pose& pose, double* rows);

/// One pose (4, 4) or many (N, 4, 4), or a list of poses.
std::vector<Pose> poses_from(nb::handle value, const char* name);

/// The task's name, or None for the default.
template <>
struct Value<Task> {
  static std::string type() { return "str"; }
  static nb::object to(const Task& value) { return Value<std::string>::to(beeline::name(value)); }
  static Task from(nb::handle value, const char* name) {
    return task_named(Value<std::string>::from(value, name));
  }
  static bool same(const Task& a, const Task& b) { return a == b; }
};

/// The arm's task of that name, or its default for None.
inline Task task_of(const Arm& arm, nb::handle task) {
  return task.is_none() ? default_task(arm)
                        : task_named(Value<std::string>::from(task, "task"), arm);
}

template <>
struct Value<std::vector<double>> {
  static constexpr bool large = true;
  static std::string type() { return array_type; }
  static nb::object to(const std::vector<double>& value);
  static std::vector<double> from(nb::handle value, const char* name);
  static bool same(const std::vector<double>& a, const std::vector<double>& b);
};

template <>
struct Value<std::vector<std::size_t>> {
  static constexpr bool large = true;
  static std::string type() { return "numpy.typing.NDArray[numpy.int64]"; }
  static nb::object to(const std::vector<std::size_t>& value) { return index_array(value); }
  static std::vector<std::size_t> from(nb::handle value, const char* name);
  static bool same(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
    return a == b;
  }
};

template <>
struct Value<std::vector<bool>> {
  static std::string type() { return "list[bool]"; }
  static std::string argument_type() { return "collections.abc.Sequence[bool]"; }
  static nb::object to(const std::vector<bool>& value);
  static std::vector<bool> from(nb::handle value, const char* name);
  static bool same(const std::vector<bool>& a, const std::vector<bool>& b) { return a == b; }
};

/// One configuration in each row.
template <>
struct Value<std::vector<Configuration>> {
  static constexpr bool large = true;
  static std::string type() { return array_type; }
  static nb::object to(const std::vector<Configuration>& value);
  static std::vector<Configuration> from(nb::handle value, const char* name);
  static bool same(const std::vector<Configuration>& a, const std::vector<Configuration>& b);
};

template <>
struct Value<std::vector<Pose>> {
  static constexpr bool large = true;
  static std::string type() { return array_type; }
  static nb::object to(const std::vector<Pose>& value);
  static std::vector<Pose> from(nb::handle value, const char* name) {
    return poses_from(value, name);
  }
  static bool same(const std::vector<Pose>& a, const std::vector<Pose>& b);
};

/// All other vectors are lists.
template <class T>
struct Value<std::vector<T>> {
  static std::string type() { return "list[" + Value<T>::type() + "]"; }
  static std::string argument_type() {
    return "collections.abc.Sequence[" + python::argument_type<T>() + "]";
  }
  static nb::object to(const std::vector<T>& value) {
    nb::list list;
    for (const T& item : value) list.append(Value<T>::to(item));
    return list;
  }
  static std::vector<T> from(nb::handle value, const char* name) {
    if (!is_list(value)) {
      raise_type(name, "a list", value);
    }
    std::vector<T> items;
    for (nb::handle item : nb::borrow(value)) items.push_back(Value<T>::from(item, name));
    return items;
  }
  static bool same(const std::vector<T>& a, const std::vector<T>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!python::same(a[i], b[i])) return false;
    }
    return true;
  }
};

/// Pairs are tuples.
template <class T>
struct Value<std::array<T, 2>> {
  static constexpr bool large = true;
  static std::string type() { return "tuple[" + Value<T>::type() + ", " + Value<T>::type() + "]"; }
  static std::string argument_type() { return Value<std::vector<T>>::argument_type(); }
  static nb::object to(const std::array<T, 2>& value) {
    return nb::make_tuple(Value<T>::to(value[0]), Value<T>::to(value[1]));
  }
  static std::array<T, 2> from(nb::handle value, const char* name) {
    std::vector<T> items = Value<std::vector<T>>::from(value, name);
    if (items.size() != 2) {
      throw Error(std::string(name) + " has " + std::to_string(items.size()) +
                  " values; expected 2");
    }
    return {std::move(items[0]), std::move(items[1])};
  }
  static bool same(const std::array<T, 2>& a, const std::array<T, 2>& b) {
    return python::same(a[0], b[0]) && python::same(a[1], b[1]);
  }
};

/// Enumerations are the names that the command line has for them, otherwise the names of
/// the enumerators.
template <class Enum>
std::vector<Enum> choices() {
  std::vector<Enum> all;
  for (std::size_t i = 0; i < enumerators<Enum>.size(); ++i) all.push_back(static_cast<Enum>(i));
  return all;
}
template <class Enum>
std::string spelling(Enum value) {
  if constexpr (requires { name(value); }) {
    return std::string(name(value));  // found beside the type
  } else {
    return std::string(enumerators<Enum>[static_cast<std::size_t>(value)]);
  }
}

/// The error for a name that is none of them.
template <class Enum>
Error unknown_choice(const char* argument, const std::string& given) {
  std::vector<std::string> names;
  for (Enum choice : choices<Enum>()) names.push_back(spelling(choice));
  return unknown_name(argument, given, names);
}

template <class Enum>
requires std::is_enum_v<Enum>
struct Value<Enum> {
  static std::string type() {
    std::string list;
    for (Enum value : choices<Enum>()) {
      list += (list.empty() ? "'" : ", '") + spelling(value) + "'";
    }
    return "typing.Literal[" + list + "]";
  }
  static nb::object to(Enum value) { return Value<std::string>::to(spelling(value)); }
  static Enum from(nb::handle value, const char* name) {
    static const std::vector<std::string> names = [] {
      std::vector<std::string> all;
      for (Enum choice : choices<Enum>()) all.push_back(spelling(choice));
      return all;
    }();
    static const std::vector<Enum> values = choices<Enum>();
    if (!PyUnicode_Check(value.ptr())) raise_type(name, "text", value);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (PyUnicode_CompareWithASCIIString(value.ptr(), names[i].c_str()) == 0) return values[i];
    }
    throw unknown_choice<Enum>(name, Value<std::string>::from(value, name));
  }
  static bool same(Enum a, Enum b) { return a == b; }
};

}  // namespace beeline::python
