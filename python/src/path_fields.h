#pragma once

#include <beeline/path/blend.h>
#include <beeline/path/joint_path.h>
#include <beeline/path/tool_path.h>

#include "kinematics_fields.h"

namespace beeline::python {

template <>
inline std::vector<PathKind> choices() {
  return {PathKind::line, PathKind::screw, PathKind::arc, PathKind::spline};
}

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
struct Fields<Line> {
  static constexpr const char* name = "Line";
  static constexpr const char* doc =
      "A straight line for the tool, whose orientation follows the shortest rotation. Poses of "
      "segments and paths are world_T_tool, arrays (4, 4); s runs from 0 to 1.";
  static constexpr std::size_t required = 2;
  static constexpr auto all() {
    return std::tuple(field("from_", &Line::from, "Pose at s = 0."),
                      field("to", &Line::to, "Pose at s = 1."));
  }
};

template <>
struct Fields<ScrewLine> {
  static constexpr const char* name = "ScrewLine";
  static constexpr const char* doc =
      "A screw motion with a rotation angle of at most pi: the tool origin moves on a helix about "
      "a fixed axis, and the orientation follows the shortest rotation.";
  static constexpr std::size_t required = 2;
  static constexpr auto all() {
    return std::tuple(field("from_", &ScrewLine::from, "Pose at s = 0."),
                      field("to", &ScrewLine::to, "Pose at s = 1."));
  }
};

template <>
struct Fields<Arc> {
  static constexpr const char* name = "Arc";
  static constexpr const char* doc =
      "A circular arc: the tool origin rotates about the axis through `centre` along `rotation`. "
      "The orientation follows the shortest rotation. See arc_through().";
  static constexpr std::size_t required = 4;
  static constexpr auto all() {
    return std::tuple(
        field("from_", &Arc::from, "Pose at s = 0."), field("to", &Arc::to, "Pose at s = 1."),
        field("centre", &Arc::centre, "In the world, m, (3,)."),
        field("rotation", &Arc::rotation,
              "Rotation vector in world axes, whose length is the arc's angle, at most 2 pi rad, "
              "(3,)."));
  }
  static void check(const Arc& arc);
};

template <>
struct Fields<SplineSegment> {
  static constexpr const char* name = "SplineSegment";
  static constexpr const char* doc =
      "A segment of a spline, or a blend. With the vectors x and r of the polynomial [x; r](s) = "
      "sum_k terms[:, k] s^k in world axes, the position is that of `centre` plus x, and the "
      "orientation exp(r) times that of `centre`.";
  static constexpr std::size_t required = 2;
  static constexpr auto all() {
    return std::tuple(field("centre", &SplineSegment::centre, "Pose (4, 4)."),
                      field("terms", &SplineSegment::terms, "Coefficients, m and rad, (6, 6)."));
  }
  static void check(const SplineSegment& segment);
};

template <>
struct Fields<ToolPath> {
  static constexpr const char* name = "ToolPath";
  static constexpr const char* doc =
      "Segments, each of which begins where the one before it ends. The path parameter s of a pose "
      "is the number of segments before it plus its segment parameter: 2.25 is a quarter of the "
      "third segment.";
  static constexpr auto all() {
    return std::tuple(
        field("segments", &ToolPath::segments, "In order."),
        field("spans", &ToolPath::spans,
              "The length of each segment in the common parameter of the path, about metres."),
        field("names", &ToolPath::names,
              "Name each segment in messages; empty: `line 3`, `segment 3`."));
  }
  static void check(const ToolPath& path);
};

template <>
struct Fields<Route> {
  static constexpr const char* name = "Route";
  static constexpr const char* doc = "A path, and where the tool comes to rest on it.";
  static constexpr std::size_t required = 2;
  static constexpr auto all() {
    return std::tuple(
        field("path", &Route::path, "The path."),
        field("stops", &Route::stops,
              "Whether the tool stops after each segment; it always stops after the last."),
        field("speeds", &Route::speeds,
              "Limit of the tool origin's speed on each segment, m/s; empty: that of the options "
              "of the motion."));
  }
  static void check(const Route& route);
};

template <>
struct Fields<Blend> {
  static constexpr const char* name = "Blend";
  static constexpr const char* doc = "The blend of the corner between two lines.";
  static constexpr auto all() {
    return std::tuple(
        field("radius", &Blend::radius, "The part of each line that it replaces, m; 0: no blend."),
        field("shortened", &Blend::shortened,
              "The lines are too short for the radius that the tolerances allow."),
        field("sharp", &Blend::sharp,
              "The tool's direction reverses: no blend, the tool stops at the corner."),
        field("line_deviation", &Blend::line_deviation, "Largest deviation from the two lines."),
        field("corner_deviation", &Blend::corner_deviation,
              "Distance from the corner's pose at s = 1/2."),
        field("curvature", &Blend::curvature, "Largest curvature of the tool origin's path, 1/m."));
  }
};

template <>
struct Fields<BlendedPath> {
  static constexpr const char* name = "BlendedPath";
  static constexpr const char* doc = "Lines with blended corners.";
  static constexpr auto all() {
    return std::tuple(
        field("path", &BlendedPath::path,
              "Twice continuously differentiable except at sharp corners."),
        field("stops", &BlendedPath::stops, "After each segment: True at sharp corners only."),
        field("blends", &BlendedPath::blends, "One for each pose between the first and the last."),
        field("lines", &BlendedPath::lines,
              "Of each segment: the line that it is a part of, or blends out."));
  }
};

template <>
struct Fields<PoseMotion> {
  static constexpr const char* name = "PoseMotion";
  static constexpr const char* doc =
      "A pose that depends on a parameter, with its derivatives in world axes [v w], m and rad.";
  static constexpr auto all() {
    return std::tuple(field("pose", &PoseMotion::pose, "(4, 4)."),
                      field("velocity", &PoseMotion::velocity, "First derivative (6,)."),
                      field("acceleration", &PoseMotion::acceleration, "Second derivative (6,)."));
  }
};

}  // namespace beeline::python
