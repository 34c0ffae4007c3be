#pragma once

#include <beeline/path/blend.h>
#include <beeline/path/joint_path.h>
#include <beeline/path/tool_path.h>

#include "kinematics_fields.h"

namespace beeline::python {

/// Rows (position, orientation) of an array.
template <>
struct Value<std::vector<Deviation>> {
  static constexpr bool large = true;
  static std::string type() { return array_type; }
  static nb::object to(const std::vector<Deviation>& value);
  static std::vector<Deviation> from(nb::handle value, const char* name);
  static bool same(const std::vector<Deviation>& a, const std::vector<Deviation>& b);
};

/// One of the four classes of segments.
template <>
struct Value<Segment> {
  static std::string type() { return "Line | ScrewLine | Arc | SplineSegment"; }
  static nb::object to(const Segment& value);
  static Segment from(nb::handle value, const char* name);
  static bool same(const Segment& a, const Segment& b);
};

template <>
struct Fields<Line> : Members<&Line::from, &Line::to> {
  static constexpr std::size_t required = 2;
};

template <>
struct Fields<ScrewLine> : Members<&ScrewLine::from, &ScrewLine::to> {
  static constexpr std::size_t required = 2;
};

template <>
struct Fields<Arc> : Members<&Arc::from, &Arc::to, &Arc::centre, &Arc::rotation> {
  static constexpr std::size_t required = 4;

  static void check(const Arc& arc);
};

template <>
struct Fields<SplineSegment> : Members<&SplineSegment::centre, &SplineSegment::terms> {
  static constexpr std::size_t required = 2;

  static void check(const SplineSegment& segment);
};

template <>
struct Fields<ToolPath> : Members<&ToolPath::segments, &ToolPath::spans, &ToolPath::names> {
  static void check(const ToolPath& path);
};

template <>
struct Fields<Route> : Members<&Route::path, &Route::stops, &Route::speeds> {
  static constexpr std::size_t required = 2;

  static void check(const Route& route);
};

template <>
struct Fields<Blend>
    : Members<&Blend::radius, &Blend::shortened, &Blend::sharp, &Blend::line_deviation,
              &Blend::corner_deviation, &Blend::curvature> {};

template <>
struct Fields<BlendedPath>
    : Members<&BlendedPath::path, &BlendedPath::stops, &BlendedPath::blends, &BlendedPath::lines> {
};

template <>
struct Fields<PoseMotion>
    : Members<&PoseMotion::pose, &PoseMotion::velocity, &PoseMotion::acceleration> {};

}  // namespace beeline::python
