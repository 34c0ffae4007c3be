#include "moving_base_argument.h"

#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/io/text/numbers.h>
#include <beeline/model/moving_base.h>

#include "command/streams.h"

namespace beeline::command {
namespace {

/// The limits LOWER:UPPER, without an order: the arm refuses a lower limit above the upper one.
Limits range(const std::string& lower, const std::string& upper, const std::string& what) {
  return {.lower = parse_number(lower, what), .upper = parse_number(upper, what)};
}

/// Warns of a limit beyond 100 m.
void warn_of_millimetres(const std::string& option, const Limits& limits) {
  constexpr double far = 100;  // metres
  for (const double limit : {limits.lower, limits.upper}) {
    if (std::abs(limit) <= far) continue;
    return warn(option + ": the limit " + number(limit) +
                " m is probably in millimetres; it is read in metres");
  }
}

/// x, y, z or three numbers.
Vector3 direction(const std::string& text) {
  for (int axis = 0; axis < 3; ++axis) {
    if (text == std::string(1, "xyz"[axis])) return Vector3::Unit(axis);
  }
  if (text.find(',') == std::string::npos) {
    throw Error("the axis is x, y, z or a direction such as 1,1,0, not \"" + text + "\"");
  }
  const std::vector<double> values = parse_numbers(text, "the axis");
  if (values.size() != 3) {
    throw Error("the axis has " + std::to_string(values.size()) + " numbers; a direction has 3");
  }
  return {values[0], values[1], values[2]};
}

Arm on_rail(const Arm& arm, const std::string& text) {
  const std::vector<std::string> parts = items_of(text, ':');
  if (parts.size() < 2 || parts.size() > 3) {
    throw Error("a rail is AXIS:LENGTH or AXIS:LOWER:UPPER, such as x:2 or y:-1:1.5, not \"" +
                text + "\"");
  }
  Limits limits;
  if (parts.size() == 3) {
    limits = range(parts[1], parts[2], "a limit");
  } else {
    limits = {.lower = 0, .upper = parse_number(parts[1], "the length")};
    if (!(limits.upper > 0)) {
      throw Error("the length must be above 0 m, not " + number(limits.upper));
    }
  }
  const Arm moving = with_rail(arm, direction(parts[0]), limits);
  warn_of_millimetres("--rail", limits);
  return moving;
}

Arm on_mobile_base(const Arm& arm, const std::string& text, const UnitArgument& unit) {
  const std::vector<std::string> ranges = items_of(text, ',');
  std::vector<Limits> limits;
  for (const std::string& each : ranges) {
    const std::vector<std::string> ends = items_of(each, ':');
    if (ends.size() != 2 || ranges.size() < 2 || ranges.size() > 3) {
      throw Error(
          "a mobile base has the ranges XMIN:XMAX,YMIN:YMAX or "
          "XMIN:XMAX,YMIN:YMAX,MIN:MAX, the last of its heading, such as -2:2,-1:1, not \"" +
          text + "\"");
    }
    limits.push_back(range(ends[0], ends[1], "a limit"));
  }
  limits.resize(3);
  if (ranges.size() == 3) {
    const double largest = std::max(std::abs(limits[2].lower), std::abs(limits[2].upper));
    warn_of_angle("--mobile-base", largest, unit);
  }
  limits[2].lower = to_radians(limits[2].lower, unit.angle_unit());
  limits[2].upper = to_radians(limits[2].upper, unit.angle_unit());
  const Arm moving = with_mobile_base(arm, {.x = limits[0], .y = limits[1], .heading = limits[2]});
  warn_of_millimetres("--mobile-base", limits[0]);
  warn_of_millimetres("--mobile-base", limits[1]);
  return moving;
}

}  // namespace

std::vector<Option> MovingBaseArgument::options() {
  return {
      Option("--rail AXIS:LENGTH",
             "A rail that moves the whole arm: one prismatic joint before the arm's own, called "
             "rail. AXIS is x, y or z of the world, or a direction such as 1,1,0. The joint goes "
             "from 0 to LENGTH or, with AXIS:LOWER:UPPER, from LOWER to UPPER, in m also with "
             "--millimetres. With the joint at 0 the arm stands at --mount. The limits of its "
             "velocity are unknown unless --limits or --velocity gives them.",
             &rail),
      Option("--mobile-base RANGES",
             "A mobile base that moves the whole arm, with its rail: joints base_x and base_y "
             "along x and y of the world and base_heading about the vertical axis of the base, "
             "before the others. RANGES are XMIN:XMAX,YMIN:YMAX in m, also with --millimetres, and "
             ",MIN:MAX of the heading in rad (deg with --degrees). Without MIN:MAX the heading is "
             "not limited.",
             &mobile_base)};
}

Arm MovingBaseArgument::on(const Arm& arm, const UnitArgument& unit) const {
  Arm moving = arm;
  if (!rail.empty()) moving = for_option("--rail", [&] { return on_rail(moving, rail); });
  if (mobile_base.empty()) return moving;
  return for_option("--mobile-base", [&] { return on_mobile_base(moving, mobile_base, unit); });
}

Configuration MovingBaseArgument::at_zero(const Arm& moving, const Configuration& q) const {
  Configuration longer(moving.dof());
  const Eigen::Index added = longer.size() - q.size();
  longer.tail(q.size()) = q;
  for (Eigen::Index k = 0; k < added; ++k) {
    longer[k] = std::clamp(0.0, moving.limits(k).lower, moving.limits(k).upper);
  }
  return longer;
}

}  // namespace beeline::command
