#include <beeline/draw/arm_figure.h>

#include "bindings.h"
#include "draw_fields.h"
#include "plane_poses.h"
#include "planning_fields.h"

namespace beeline::python {
namespace {

std::vector<Pose> waypoints_from(const Arm& arm, nb::handle value) {
  return value.is_none() ? std::vector<Pose>() : PosePlane(arm).poses(value, "waypoints");
}

Picture arm_picture(const Arm& arm, nb::handle q, const nb::kwargs& keywords) {
  const auto given = options<ArmFigureOptions>(keywords);
  const Configuration at =
      q.is_none() ? display_configuration(arm) : Value<Configuration>::from(q, "q");
  return compose(arm_figure(arm, at, given));
}

void bind_chapter(nb::module_& m) {
  m.def(
      "chapter_figures", [] { return Value<std::vector<std::string>>::to(chapter_figures()); },
      nb::sig("def chapter_figures() -> list[str]"),
      "The figures of Dellaert, *Serial Link Manipulators*, that chapter_figure() draws.");
  Signature figure("chapter_figure", "Picture",
                   "Draws a figure of Dellaert, *Serial Link Manipulators*.");
  figure.takes("number", "str", "One of `chapter_figures()`, such as `1.7`.");
  define(
      m,
      [](nb::handle number) {
        return compose(chapter_figure(Value<std::string>::from(number, "number")));
      },
      figure, nb::arg("number"));
  Signature moving("chapter_animation", "Animation", comment("chapter_animation"));
  moving.takes("number", "str", "`1.7` or `1.9`.").options<PlaybackOptions>();
  define(
      m,
      [](nb::handle number, const nb::kwargs& playback) {
        const std::string name = Value<std::string>::from(number, "number");
        const auto played = options<PlaybackOptions>(playback);
        Animation drawn = without_lock([&] { return chapter_animation(name); });
        return PlayedAnimation(std::move(drawn), played);
      },
      moving, nb::arg("number"), nb::arg("playback"));
}

void bind_motion_figures(nb::module_& m) {
  constexpr const char* trajectory_doc = "Of this arm's joints.";
  constexpr const char* waypoints_doc =
      "Poses (N, 4, 4) to mark, numbered from 1; of a planar arm also (N, 3), x, y, theta each.";
  const std::string poses = std::string(arm_poses_like) + " | None";
  Signature figure("motion_figure", "Picture", comment("motion_figure"));
  figure.takes("arm", "Arm", "The arm.")
      .takes("trajectory", "Trajectory", trajectory_doc)
      .takes("waypoints", poses, waypoints_doc, "None")
      .options<ArmFigureOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, nb::handle waypoints,
         const nb::kwargs& keywords) {
        const std::vector<Pose> marked = waypoints_from(arm, waypoints);
        const auto given = options<ArmFigureOptions>(keywords);
        return without_lock([&] { return compose(motion_figure(arm, trajectory, marked, given)); });
      },
      figure, nb::arg("arm"), nb::arg("trajectory"), nb::arg("waypoints") = nb::none(),
      nb::arg("options"));
  Signature moving("motion_animation", "Animation",
                   "Draws the same in motion: the arm moves and leaves the trail of its tool.");
  moving.takes("arm", "Arm", "The arm.")
      .takes("trajectory", "Trajectory", trajectory_doc)
      .takes("waypoints", poses, waypoints_doc, "None")
      .options<ArmFigureOptions>()
      .options<PlaybackOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, nb::handle waypoints,
         const nb::kwargs& keywords) {
        const std::vector<Pose> marked = waypoints_from(arm, waypoints);
        const auto given = options<ArmFigureOptions, PlaybackOptions>(keywords);
        Animation drawn = without_lock(
            [&] { return motion_animation(arm, trajectory, marked, std::get<0>(given)); });
        return PlayedAnimation(std::move(drawn), std::get<1>(given));
      },
      moving, nb::arg("arm"), nb::arg("trajectory"), nb::arg("waypoints") = nb::none(),
      nb::arg("options"));
}

void bind_charts(nb::module_& m) {
  Signature timing("timing_figure", "Picture", comment("timing_figure"));
  timing.takes("arm", "Arm", "The arm.")
      .takes("motion", "Trajectory | PathMotion", "Of this arm's joints.")
      .keywords()
      .member<&TimingFigureOptions::title>()
      .takes("task", "str | None", "Default: planar for planar arms, else spatial.", "None")
      .takes("tolerance", "Deviation | None", "Drawn as a reference line.", "None")
      .takes("waypoint_times", array_like, comment("TimingFigureOptions::waypoint_times"), "()");
  define(
      m,
      [](const Arm& arm, nb::handle motion, nb::handle title, nb::handle task, nb::handle tolerance,
         nb::handle waypoint_times) {
        TimingFigureOptions given;
        given.title = Value<std::string>::from(title, "title");
        given.task = Value<std::optional<Task>>::from(task, "task");
        given.waypoint_times = Value<std::vector<double>>::from(waypoint_times, "waypoint_times");
        const PathMotion* along = nullptr;
        if (nb::try_cast<const PathMotion*>(motion, along) && along) {
          given.path = FollowedPath{along->path, along->path_parameters,
                                    given.task.value_or(default_task(arm)),
                                    Value<std::optional<Deviation>>::from(tolerance, "tolerance")};
          return without_lock([&] { return timing_figure(arm, along->trajectory, given); });
        }
        const auto trajectory = Value<Trajectory>::from(motion, "motion");
        return without_lock([&] { return timing_figure(arm, trajectory, given); });
      },
      timing, nb::arg("arm"), nb::arg("motion"), nb::kw_only(), nb::arg("title") = "",
      nb::arg("task") = nb::none(), nb::arg("tolerance") = nb::none(),
      nb::arg("waypoint_times") = nb::make_tuple());
  Signature responses("step_response_figure", "Picture", comment("step_response_figure"));
  responses.takes("motions", "collections.abc.Mapping[str, Trajectory]", "By the curves' names.")
      .takes("goal", array_like, "Configuration (n,).")
      .takes("title", "str", "Title.", "''");
  define(
      m,
      [](const nb::dict& motions, nb::handle goal, nb::handle title) {
        std::vector<NamedMotion> named;
        for (const auto& [name, motion] : motions) {
          named.push_back({Value<std::string>::from(name, "motions"),
                           Value<Trajectory>::from(motion, "motions")});
        }
        return step_response_figure(named, Value<Configuration>::from(goal, "goal"),
                                    Value<std::string>::from(title, "title"));
      },
      responses, nb::arg("motions"), nb::arg("goal"), nb::arg("title") = "");
}

}  // namespace

void bind_pictures(nb::module_& m) {
  bind_pages(m);
  bind_chapter(m);
  bind_motion_figures(m);
  bind_charts(m);
  Signature figure("arm_figure", "Picture", comment("arm_figure"));
  figure.takes("arm", "Arm", "The arm.")
      .takes("q", std::string(array_like) + " | None",
             "Configuration (n,). Default: `display_configuration(arm)`.", "None")
      .options<ArmFigureOptions>();
  define(m, &arm_picture, figure, nb::arg("arm"), nb::arg("q") = nb::none(), nb::arg("options"));
  Signature shown(
      "display_configuration", array_type,
      "Returns a configuration (n,) that shows the arm well: the middle of the position limits or, "
      "where the arm is singular there, one far from singularities.");
  shown.takes("arm", "Arm", "The arm.");
  define(
      m, [](const Arm& arm) { return Value<Configuration>::to(display_configuration(arm)); }, shown,
      nb::arg("arm"));
  Signature colours("distinct_colour", "tuple[float, float, float]",
                    "Returns colour k of a cycle of eight, red, green and blue from 0 to 1: 0 red, "
                    "1 green, 2 blue (the axes x, y, z and joints 1, 2, 3), then five others.");
  colours.takes("k", "int", "From 0.");
  define(
      m,
      [](nb::handle k) {
        const Colour colour = distinct_colour(
            static_cast<int>(integer_from(k, "k", 0, std::numeric_limits<int>::max())));
        return nb::make_tuple(colour.red, colour.green, colour.blue);
      },
      colours, nb::arg("k"));
  // Notebooks draw an arm, and the joints of a trajectory over time.
  auto arm = nb::borrow<nb::class_<Arm>>(nb::type<Arm>());
  arm.def("_repr_svg_", [](const Arm& self) {
    return notebook_svg(compose(arm_figure(self, display_configuration(self))));
  });
  auto trajectory = nb::borrow<nb::class_<Trajectory>>(nb::type<Trajectory>());
  trajectory.def(
      "_repr_svg_",
      [](const Trajectory& self) -> nb::object {
        return self.times.empty() ? nb::none() : nb::object(notebook_svg(timing_figure(self)));
      },
      nb::sig("def _repr_svg_(self) -> str | None"));
}

}  // namespace beeline::python
