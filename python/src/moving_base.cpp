#include <cmath>

#include <beeline/error.h>
#include <beeline/model/moving_base.h>

#include "arm_fields.h"
#include "bindings.h"
#include "signature.h"

namespace beeline::python {
namespace {

/// The axis x, y or z, or a direction.
Vector3 axis_from(nb::handle value) {
  if (!nb::isinstance<nb::str>(value)) return finite_from<Vector3>(value, "axis");
  const auto name = Value<std::string>::from(value, "axis");
  for (int axis = 0; axis < 3; ++axis) {
    if (name == std::string(1, "xyz"[axis])) return Vector3::Unit(axis);
  }
  throw unknown_name("axis", name, {"x", "y", "z"});
}

/// A limit, or `unlimited` without one.
double limit_from(nb::handle value, const char* name, double unlimited) {
  if (value.is_none()) return unlimited;
  const auto limit = Value<double>::from(value, name);
  if (!std::isfinite(limit)) throw Error(std::string(name) + " has a value that is not finite");
  return limit;
}

Limits range_from(nb::handle value, const char* name) {
  if (value.is_none()) return {};
  const auto range = finite_from<Eigen::Vector2d>(value, name);
  return {.lower = range[0], .upper = range[1]};
}

}  // namespace

void bind_moving_bases(nb::class_<Arm>& arm) {
  Signature rail(
      "with_rail", "Arm",
      "Returns a copy on a rail: a prismatic joint called `rail`, before the arm's own joints, "
      "moves the whole arm along an axis of the world; with the rail at 0 m the arm stands where "
      "it stood. Limits of velocity are unknown; with_limits({\"rail\": {\"velocity\": 1}}) sets "
      "one. Raises Error for an axis without a direction and for a lower limit above the upper "
      "one.");
  rail.takes("self")
      .takes("axis", std::string("str | ") + array_like,
             "`x`, `y` or `z`, or a direction (3,) of any length.")
      .takes("lower", "float | None", "Lower position limit, m, finite; None: not limited.", "None")
      .takes("upper", "float | None", "Upper position limit, m, finite; None: not limited.",
             "None");
  define(
      arm,
      [](const Arm& self, nb::handle axis, nb::handle lower, nb::handle upper) {
        const Limits unlimited;
        return with_rail(self, axis_from(axis),
                         {.lower = limit_from(lower, "lower", unlimited.lower),
                          .upper = limit_from(upper, "upper", unlimited.upper)});
      },
      rail, nb::arg("axis"), nb::arg("lower") = nb::none(), nb::arg("upper") = nb::none());
  const std::string range = std::string(array_like) + " | None";
  Signature base(
      "with_mobile_base", "Arm",
      "Returns a copy on a mobile base, which moves in the plane in every direction: the joints "
      "`base_x` and `base_y`, along x and y of the world, and `base_heading`, about the vertical "
      "axis of the base, before the arm's own. With all three at 0 the arm stands where it stood "
      "and the origin of the world is the centre of the base. Limits of velocity are unknown, as "
      "of with_rail(). Raises Error for a lower limit above the upper one.");
  base.takes("self")
      .takes("x", range, "Lower and upper limit of x (2,), m, finite; None: not limited.", "None")
      .takes("y", range, "Lower and upper limit of y (2,), m, finite; None: not limited.", "None")
      .takes("heading", range,
             "Lower and upper limit of the heading (2,), rad, finite; None: not limited.", "None");
  define(
      arm,
      [](const Arm& self, nb::handle x, nb::handle y, nb::handle heading) {
        return with_mobile_base(self, {.x = range_from(x, "x"),
                                       .y = range_from(y, "y"),
                                       .heading = range_from(heading, "heading")});
      },
      base, nb::arg("x") = nb::none(), nb::arg("y") = nb::none(), nb::arg("heading") = nb::none());
}

}  // namespace beeline::python
