#pragma once

#include <optional>

#include <beeline/model/arm.h>

#include "plane_poses.h"
#include "record.h"

namespace beeline::python {

// Python's lock is held during each step, so threads that share an object take turns.

inline constexpr const char* configuration_doc = "Configuration (n,).";

/// The docstring of a loop's class: the header's comment, and what differs in Python.
inline const char* loop_class_doc(std::string_view name) {
  return kept_text(std::string(comment(name)) +
                   "\n\nIn Python a step allocates its result. Threads that share an object take "
                   "turns. A copy is independent, in the same state. It equals only itself, and "
                   "has no pickle: pickle what it is made of.");
}

/// A loop, and what it was made of, for its repr().
template <class Loop>
struct Described : Loop {
  template <class... Arguments>
  explicit Described(std::string text, const Arguments&... arguments)
      : Loop(arguments...), made_of(std::move(text)) {}
  std::string made_of;
  std::optional<PosePlane> plane = {};  ///< of commanded poses, for loops that follow them
  nb::object model;                     ///< that the loop refers to; null for none
};

/// The object of the keyword `model`, which a loop keeps.
inline nb::object model_of(const nb::kwargs& options) {
  return options.contains("model") ? nb::object(options["model"]) : nb::object();
}

/// `panda, gain=5`
inline std::string described(const std::string& first, const nb::kwargs& options) {
  std::string text = first;
  for (const auto& [name, value] : options) {
    text += std::string(", ") + nb::str(name).c_str() + "=" + field_text(value);
  }
  return text;
}

/// Adds copies, repr(), and what refuses pickles: the state of a loop is of this process.
template <class Loop>
void bind_copies(nb::class_<Loop>& loop, const char* name, const char* parts) {
  bind_copy(loop, name, [](nb::handle self) { return Loop(nb::cast<const Loop&>(self)); });
  loop.def(
      "__reduce__",
      [name, parts](const Loop&) -> nb::object {
        throw nb::type_error((std::string(name) +
                              " has no pickle, as it has the state of a loop; pickle " + parts +
                              ", and make another")
                                 .c_str());
      },
      nb::sig("def __reduce__(self) -> typing.NoReturn"));
  loop.def("__repr__", [name](const Loop& self) {
    return "<beeline." + std::string(name) + " of " + self.made_of + ">";
  });
}

/// The numbers of an argument (n,), in the caller's memory where that is possible.
class Numbers {
 public:
  Numbers(nb::handle value, const char* name) : array_(value, name) {
    if (array_.dimensions() == 1) return;
    throw Error(std::string(name) + " has the shape " + shape_text(array_.shape()) +
                "; expected (n,)");
  }
  operator ConfigurationRef() const {
    return Eigen::Map<const Configuration>(array_.data(), size());
  }
  Index size() const { return array_.size(); }

 private:
  InputArray array_;
};

/// The caller's arrays for results: one, or a tuple of two; none for None. Checked on construction,
/// before the step is made.
class Outputs {
 public:
  Outputs(nb::handle out, Index n) {
    if (out.is_none()) return;
    const Index shape[] = {n};
    if (!nb::isinstance<nb::tuple>(out)) {
      first_.emplace(out, "out", shape, Real::float64);
      return;
    }
    const auto both = nb::borrow<nb::tuple>(out);
    if (both.size() != 2) throw nb::type_error("out: expected an array, or a tuple of two");
    first_.emplace(both[0], "out[0]", shape, Real::float64);
    second_.emplace(both[1], "out[1]", shape, Real::float64);
  }
  void write(const Configuration& first, const Configuration& second) {
    write(first_, first);
    write(second_, second);
  }

 private:
  static void write(std::optional<OutputArray>& out, const Configuration& values) {
    if (!out) return;
    std::copy(values.begin(), values.end(), out->data());
    out->finish();
  }
  std::optional<OutputArray> first_, second_;
};

inline std::string outputs_type() {
  const std::string array = array_type;
  return array + " | tuple[" + array + ", " + array + "] | None";
}

}  // namespace beeline::python
