#include <cmath>

#include "bindings.h"
#include "path_fields.h"

namespace beeline::python {
namespace {

constexpr const char* poses_doc = "Poses world_T_tool, (N, 4, 4) or a list of them.";

double parameter_from(nb::handle s) {
  const double value = Value<double>::from(s, "s");
  if (!std::isfinite(value)) throw Error("s is not finite: " + number(value));
  return value;
}

const ToolPath& with_segments(const ToolPath& path) {
  if (path.segments.empty()) throw Error("the path has no segments");
  return path;
}

/// Poses of a segment or a path at s, of any shape.
template <class Along>
nb::object poses_at(const Along& along, nb::handle s) {
  const InputArray parameters(s, "s");
  std::vector<Index> shape(parameters.shape().begin(), parameters.shape().end());
  shape.insert(shape.end(), {4, 4});
  NewArray poses(shape);
  for (Index i = 0; i < parameters.size(); ++i) {
    const double parameter = parameters.data()[i];
    if (!std::isfinite(parameter)) throw Error("s is not finite: " + number(parameter));
    write_pose(pose_at(along, parameter), poses.data() + 16 * i);
  }
  return poses.release();
}

void make_path(ToolPath* self, nb::handle segments, nb::handle spans, nb::handle names) {
  ToolPath path{Value<std::vector<Segment>>::from(segments, "segments"), {}, {}};
  if (spans.is_none()) {
    for (const Segment& segment : path.segments) {
      const double ends = span_of({pose_at(segment, 0), pose_at(segment, 1)});
      const bool line = std::holds_alternative<Line>(segment);
      path.spans.push_back(line ? ends : std::max(length_of(segment), ends));
    }
  } else {
    path.spans = Value<std::vector<double>>::from(spans, "spans");
  }
  path.names = Value<std::vector<std::string>>::from(names, "names");
  Fields<ToolPath>::check(path);
  new (self) ToolPath(std::move(path));
}

template <class T>
void bind_segment(nb::module_& m) {
  nb::class_<T> bound = bind_record<T>(m);
  Signature back("reversed", Fields<T>::name,
                 "Returns the segment traversed from its end to its beginning. One that rotates by "
                 "exactly pi may rotate in the other direction.");
  back.takes("self");
  define(
      bound, [](const T& self) { return Value<Segment>::to(reversed(Segment(self))); }, back);
}

void bind_evaluation(nb::module_& m) {
  const std::string kinds = Value<Segment>::type() + " | ToolPath";
  Signature pose("pose_at", array_type, "Returns the pose world_T_tool at s.");
  pose.takes("along", kinds, "Segment, with s from 0 to 1, or path.")
      .takes("s", array_like, "Path parameter, or parameters of any shape.")
      .returns("(4, 4), or (..., 4, 4).");
  define(
      m,
      [](nb::handle along, nb::handle s) {
        const ToolPath* path = nullptr;
        if (nb::try_cast<const ToolPath*>(along, path) && path) {
          return poses_at(with_segments(*path), s);
        }
        return poses_at(Value<Segment>::from(along, "along"), s);
      },
      pose, nb::arg("along"), nb::arg("s"));
  Signature motion("motion_at", "PoseMotion",
                   "Returns the pose at s, and its derivatives with respect to s.");
  motion.takes("segment", Value<Segment>::type(), "Segment.")
      .takes("s", "float", "Segment parameter, from 0 to 1.");
  define(
      m,
      [](nb::handle segment, nb::handle s) {
        return motion_at(Value<Segment>::from(segment, "segment"), parameter_from(s));
      },
      motion, nb::arg("segment"), nb::arg("s"));
  Signature length("length_of", "float",
                   "Returns the path length of the tool origin, m. Exact except for splines, which "
                   "are integrated to about ten digits unless the origin comes to rest.");
  length.takes("segment", Value<Segment>::type(), "Segment.");
  define(
      m, [](nb::handle segment) { return length_of(Value<Segment>::from(segment, "segment")); },
      length, nb::arg("segment"));
  Signature span("span_of", "float",
                 "Returns the span of a line, m: its length, or 0.01 m for each radian of its "
                 "rotation where that is larger.");
  span.takes("line", "Line", "Line.");
  define(
      m, [](const Line& line) { return span_of(line); }, span, nb::arg("line"));
}

void bind_tool_path(nb::module_& m) {
  nb::class_<ToolPath> path = bind_record<ToolPath>(m);
  Signature made("__init__", "None",
                 "Makes a path of segments. Raises Error for segments that do not connect.");
  made.takes("self")
      .takes("segments", argument_type<std::vector<Segment>>(), "One after the other.")
      .takes("spans", std::string(array_like) + " | None", "Of each, about m.", "None")
      .takes("names", "collections.abc.Sequence[str]", "Of each, or none.", "()");
  define(path, &make_path, made, nb::arg("segments"), nb::arg("spans") = nb::none(),
         nb::arg("names") = nb::make_tuple());
  const auto add = [&path](auto function, Signature signature) {
    signature = Signature(signature).takes("s", "float", "Path parameter.");
    define(path, function, signature, nb::arg("s"));
  };
  add([](const ToolPath& self,
         nb::handle s) { return span_to(with_segments(self), parameter_from(s)); },
      Signature("span_to", "float", "Returns the span from the path's beginning to s, about m.")
          .takes("self"));
  add([](const ToolPath& self,
         nb::handle s) { return corner_at(with_segments(self), parameter_from(s)); },
      Signature("corner_at", "bool",
                "Returns whether the tool's velocity with respect to the common parameter is "
                "discontinuous at s, as where lines meet.")
          .takes("self"));
  add([](const ToolPath& self,
         nb::handle s) { return segment_at(with_segments(self), parameter_from(s)); },
      Signature(
          "segment_at", "int",
          "Returns the index of the segment at s; where two meet, of the one that ends there.")
          .takes("self"));
  Signature back("reversed", "ToolPath",
                 "Returns the path traversed from its end to its beginning.");
  back.takes("self");
  define(
      path, [](const ToolPath& self) { return reversed(self); }, back);
}

void bind_paths_through(nb::module_& m) {
  Signature arc("arc_through", "Arc",
                "Returns the arc from `from_` to `to` through a third position. Raises Error where "
                "the three positions do not determine a circle.");
  arc.takes("from_", array_like, pose_doc)
      .takes("passed", array_like, "Position, m, (3,).")
      .takes("to", array_like, pose_doc);
  define(
      m,
      [](nb::handle from, nb::handle passed, nb::handle to) {
        const Vector3 position = Value<Vector3>::from(passed, "passed");
        if (!position.allFinite()) throw Error("passed has a value that is not finite");
        return arc_through(Value<Pose>::from(from, "from_"), position, Value<Pose>::from(to, "to"));
      },
      arc, nb::arg("from_"), nb::arg("passed"), nb::arg("to"));

  Signature through("path_through", "ToolPath", comment("path_through"));
  through.takes("poses", array_like, poses_doc)
      .takes("kind", Value<PathKind>::type(), "Kind of the segments.", "'line'")
      .keywords()
      .takes("first", std::string(array_like) + " | None",
             "Velocity of a spline at its beginning with respect to the common parameter, in world "
             "axes, (6,); None: zero acceleration.",
             "None")
      .takes("last", std::string(array_like) + " | None", "The same at its end.", "None");
  define(
      m,
      [](nb::handle poses, nb::handle kind, nb::handle first, nb::handle last) {
        using End = Value<std::optional<Twist>>;
        const SplineEnds ends{End::from(first, "first"), End::from(last, "last")};
        for (const auto& end : {ends.first, ends.last}) {
          if (end && !end->allFinite()) throw Error("first, last: a value is not finite");
        }
        return path_through(poses_from(poses, "poses"), Value<PathKind>::from(kind, "kind"), ends);
      },
      through, nb::arg("poses"), nb::arg("kind") = "line", nb::kw_only(),
      nb::arg("first") = nb::none(), nb::arg("last") = nb::none());
  Signature lines(
      "lines_through", "ToolPath",
      "Returns straight lines through the poses in order; a pose may repeat the one before it.");
  lines.takes("poses", array_like, poses_doc);
  define(
      m, [](nb::handle poses) { return lines_through(poses_from(poses, "poses")); }, lines,
      nb::arg("poses"));
}

void bind_routes(nb::module_& m) {
  bind_record<Route>(m);
  bind_record<Blend>(m);
  bind_record<BlendedPath>(m);
  Signature route("route_of", "Route",
                  "Returns the route along a path: lines, screws and arcs stop where two of them "
                  "meet, splines only where they turn back, blended lines at sharp corners only.");
  route.takes("path", "ToolPath | BlendedPath", "Path.")
      .takes("kind", Value<PathKind>::type(), "Kind of its segments; of blended lines ignored.",
             "'line'");
  define(
      m,
      [](nb::handle path, nb::handle kind) {
        const BlendedPath* blended = nullptr;
        if (nb::try_cast<const BlendedPath*>(path, blended) && blended) return route_of(*blended);
        const ToolPath given = Value<ToolPath>::from(path, "path");
        return route_of(with_segments(given), Value<PathKind>::from(kind, "kind"));
      },
      route, nb::arg("path"), nb::arg("kind") = "line");
  Signature lines("blended_lines", "BlendedPath", comment("blended_lines"));
  lines.takes("poses", array_like, poses_doc)
      .takes("within",
             argument_type<Deviation>() + " | collections.abc.Sequence[" +
                 argument_type<Deviation>() + "]",
             "Tolerance: the largest deviation of a blend from its corner and from both lines, m "
             "and rad, 1e-4 or more; or a list with one for each inner pose.");
  define(
      m,
      [](nb::handle poses, nb::handle within) {
        const std::vector<Pose> given = poses_from(poses, "poses");
        if (!nb::isinstance<nb::list>(within)) {
          return blended_lines(given, Value<Deviation>::from(within, "within"));
        }
        std::vector<Deviation> each;
        for (nb::handle item : nb::borrow<nb::list>(within)) {
          each.push_back(Value<Deviation>::from(item, "within"));
        }
        return blended_lines(given, each);
      },
      lines, nb::arg("poses"), nb::arg("within"));
}

}  // namespace

void bind_paths(nb::module_& m) {
  bind_record<PoseMotion>(m);
  bind_segment<Line>(m);
  bind_segment<ScrewLine>(m);
  bind_segment<Arc>(m);
  bind_segment<SplineSegment>(m);
  bind_evaluation(m);
  bind_tool_path(m);
  bind_paths_through(m);
  bind_routes(m);
  m.attr("metres_per_radian") = metres_per_radian;
}

}  // namespace beeline::python
