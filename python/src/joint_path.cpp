#include <cmath>

#include "bindings.h"
#include "interruption.h"
#include "joint_path_fields.h"

namespace beeline::python {
namespace {

PathPoint point_of(const JointPath& path, nb::handle step, nb::handle u) {
  const auto k = Value<std::size_t>::from(step, "step");
  if (k + 1 >= path.size()) {
    throw Error("step " + std::to_string(k) + " is not of the path: it has " +
                std::to_string(path.size() - std::min<std::size_t>(path.size(), 1)) + " steps");
  }
  const double fraction = Value<double>::from(u, "u");
  if (!std::isfinite(fraction)) throw Error("u is not finite: " + number(fraction));
  return path_point(path, k, fraction);
}

void check_options(const RefineOptions& options) {
  if (options.min_steps < 1 || !(options.max_change > 0) || options.max_parts < 1) {
    throw Error("min_steps, max_change and max_parts must be above 0");
  }
  constexpr std::size_t most = 10'000'000;
  if (options.min_steps > most || options.max_parts > 100'000) {
    throw Error("min_steps must be at most 10000000, max_parts 100000");
  }
}

void bind_path_points(nb::module_& m) {
  Signature point("path_point", "PathPoint",
                  "Evaluates the path in one step, between the grid points `step` and `step + 1`.");
  point.takes("path", "JointPath", "Path.")
      .takes("step", "int", "Index of the step.")
      .takes("u", "float", "Fraction of the step, from 0 to 1.");
  define(m, &point_of, point, nb::arg("path"), nb::arg("step"), nb::arg("u"));
}

void bind_joint_splines(nb::module_& m) {
  Signature spline("joint_spline", "JointPath", comment("joint_spline"));
  spline.takes("samples", array_like, "Configurations (N, n).")
      .takes("parameter", array_like, "Path parameter of each, strictly increasing, (N,).");
  define(
      m,
      [](nb::handle samples, nb::handle parameter) {
        return joint_spline(Value<std::vector<Configuration>>::from(samples, "samples"),
                            Value<std::vector<double>>::from(parameter, "parameter"));
      },
      spline, nb::arg("samples"), nb::arg("parameter"));
  Signature smooth(
      "smooth_derivatives", "JointPath",
      "Returns the path made four times continuously differentiable at its inner grid points by "
      "changing dq and ddq there; positions, and the derivatives at both ends, stay.");
  smooth.takes("path", "JointPath", "Path.");
  define(
      m,
      [](const JointPath& given) {
        JointPath path = given;
        smooth_derivatives(path);
        return path;
      },
      smooth, nb::arg("path"));
  Signature chord(
      "chord_length", array_type,
      "Returns the arc length along the joint-space polyline, for each sample; 0 first.");
  chord.takes("samples", array_like, "Configurations (N, n).");
  define(
      m,
      [](nb::handle samples) {
        return Value<std::vector<double>>::to(
            chord_length(Value<std::vector<Configuration>>::from(samples, "samples")));
      },
      chord, nb::arg("samples"));
}

void bind_refinement(nb::module_& m) {
  Signature fine("refined", "JointPath",
                 "Returns the same path with more grid points: steps that are longer or curve more "
                 "than the options allow are divided into equal parts. At most 1e7 grid points. "
                 "Without grid points where the budget ends it.");
  fine.takes("path", "JointPath", "Path.").options<RefineOptions>();
  define(
      m,
      [](const JointPath& path, const nb::kwargs& keywords) {
        auto given = options<RefineOptions>(keywords);
        check_options(given);
        return unlocked(given.budget, [&] { return refined(path, given); });
      },
      fine, nb::arg("path"), nb::arg("keywords"));
}

}  // namespace

void bind_joint_paths(nb::module_& m) {
  nb::class_<JointPath> bound = bind_record<JointPath>(m);
  bound.def("__len__", &JointPath::size, "Number of grid points.");
  bind_record<PathPoint>(m);
  bind_path_points(m);
  bind_joint_splines(m);
  bind_refinement(m);
}

}  // namespace beeline::python
