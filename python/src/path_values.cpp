#include <cmath>
#include <numbers>

#include "path_fields.h"

namespace beeline::python {

nb::object Value<std::vector<Deviation>>::to(const std::vector<Deviation>& value) {
  NewArray array({static_cast<Index>(value.size()), 2});
  double* next = array.data();
  for (const Deviation& deviation : value) {
    *next++ = deviation.position;
    *next++ = deviation.orientation;
  }
  return array.release_read_only();
}

std::vector<Deviation> Value<std::vector<Deviation>>::from(nb::handle value, const char* name) {
  std::vector<Deviation> deviations;
  for (const Configuration& row : Value<std::vector<Configuration>>::from(value, name)) {
    if (row.size() != 2) throw Error(std::string(name) + ": expected rows (position, orientation)");
    deviations.push_back({row[0], row[1]});
  }
  return deviations;
}

bool Value<std::vector<Deviation>>::same(const std::vector<Deviation>& a,
                                         const std::vector<Deviation>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), Value<Deviation>::same);
}

nb::object Value<Segment>::to(const Segment& value) {
  return std::visit([](const auto& segment) { return nb::object(nb::cast(segment)); }, value);
}

Segment Value<Segment>::from(nb::handle value, const char* name) {
  if (nb::isinstance<Line>(value)) return nb::cast<Line>(value);
  if (nb::isinstance<ScrewLine>(value)) return nb::cast<ScrewLine>(value);
  if (nb::isinstance<Arc>(value)) return nb::cast<Arc>(value);
  if (nb::isinstance<SplineSegment>(value)) return nb::cast<SplineSegment>(value);
  raise_type(name, type(), value);
}

bool Value<Segment>::same(const Segment& a, const Segment& b) {
  if (a.index() != b.index()) return false;
  return std::visit(
      [&b](const auto& segment) {
        using T = std::decay_t<decltype(segment)>;
        return Value<T>::same(segment, std::get<T>(b));
      },
      a);
}

void Fields<Arc>::check(const Arc& arc) {
  constexpr double rounding = 1e-9;
  if (!arc.centre.allFinite()) throw Error("centre has a value that is not finite");
  const double angle = arc.rotation.norm();
  if (angle > 0 && angle <= 2 * std::numbers::pi + rounding) return;
  throw Error("the length of rotation must be above 0 and at most 2 pi, not " + number(angle));
}

void Fields<SplineSegment>::check(const SplineSegment& segment) {
  if (!segment.terms.allFinite()) throw Error("terms has a value that is not finite");
}

void Fields<ToolPath>::check(const ToolPath& path) {
  constexpr double rounding = 1e-6;  // metres and radians
  const std::size_t segments = path.segments.size();
  if (path.spans.size() != segments || (!path.names.empty() && path.names.size() != segments)) {
    throw Error("a path of " + std::to_string(segments) + " segments has " +
                std::to_string(path.spans.size()) + " spans and " +
                std::to_string(path.names.size()) + " names");
  }
  for (std::size_t i = 0; i < segments; ++i) {
    if (!(std::isfinite(path.spans[i]) && path.spans[i] > 0)) {
      throw Error("spans: " + number(path.spans[i]) + " of segment " + std::to_string(i + 1) +
                  " is not above zero");
    }
    if (i == 0) continue;
    const Twist gap =
        pose_difference(pose_at(path.segments[i], 0), pose_at(path.segments[i - 1], 1));
    const Deviation apart{gap.head<3>().norm(), gap.tail<3>().norm()};
    if (within(apart, {rounding, rounding})) continue;
    throw Error("segment " + std::to_string(i + 1) + " begins " + deviation_text(apart) +
                " from the end of the one before it");
  }
}

void Fields<Route>::check(const Route& route) {
  const std::size_t segments = route.path.segments.size();
  if (route.stops.size() == segments && (route.speeds.empty() || route.speeds.size() == segments)) {
    return;
  }
  throw Error("a route of " + std::to_string(segments) + " segments has " +
              std::to_string(route.stops.size()) + " stops and " +
              std::to_string(route.speeds.size()) + " speeds");
}

}  // namespace beeline::python
