#include <beeline/draw/arm_figure.h>

#include "bindings.h"
#include "collision_fields.h"
#include "draw_fields.h"
#include "followed_program.h"
#include "plane_poses.h"
#include "planning_fields.h"

namespace beeline::python {
namespace {

std::vector<Pose> waypoints_from(const Arm& arm, nb::handle value) {
  return value.is_none() ? std::vector<Pose>() : PosePlane(arm).poses(value, "waypoints");
}

const Arm& arm_of(const Arm& arm) { return arm; }
const Arm& arm_of(const CollisionModel& model) { return model.arm(); }

/// The picture of an arm, or of the arm of a model among its obstacles.
template <class Drawn>
Picture arm_picture(const Drawn& drawn, nb::handle q, const nb::kwargs& keywords) {
  const auto given = options<ArmFigureOptions>(keywords);
  const Configuration at =
      q.is_none() ? display_configuration(arm_of(drawn)) : Value<Configuration>::from(q, "q");
  return without_lock([&] { return compose(arm_figure(drawn, at, given)); });
}

Picture motion_picture(const Arm& arm, const Trajectory& trajectory, nb::handle waypoints,
                       const nb::kwargs& keywords) {
  const std::vector<Pose> marked = waypoints_from(arm, waypoints);
  const auto given = options<ArmFigureOptions>(keywords);
  return without_lock([&] { return compose(motion_figure(arm, trajectory, marked, given)); });
}

/// Draws a motion by `draw` with the model, or with the scenes of the program that it follows.
template <class Draw>
auto drawn_among(const CollisionModel& model, const Trajectory& trajectory,
                 const std::optional<FollowedProgram>& followed, const Draw& draw) {
  if (!followed) return draw(model);
  const std::vector<ProgramScene> scenes =
      program_scenes(model, trajectory, *followed->program, followed->arrivals);
  return draw(std::span<const ProgramScene>(scenes));
}

Picture motion_picture_among(const CollisionModel& model, const Trajectory& trajectory,
                             nb::handle waypoints, nb::handle program, nb::handle arrivals,
                             const nb::kwargs& keywords) {
  const std::vector<Pose> marked = waypoints_from(model.arm(), waypoints);
  const std::optional<FollowedProgram> followed = followed_from(program, arrivals);
  const auto given = options<ArmFigureOptions>(keywords);
  return without_lock([&] {
    return drawn_among(model, trajectory, followed, [&](const auto& drawn) {
      return compose(motion_figure(drawn, trajectory, marked, given));
    });
  });
}

PlayedAnimation played_motion(const Arm& arm, const Trajectory& trajectory, nb::handle waypoints,
                              const nb::kwargs& keywords) {
  const std::vector<Pose> marked = waypoints_from(arm, waypoints);
  const auto given = options<ArmFigureOptions, PlaybackOptions>(keywords);
  Animation animation =
      without_lock([&] { return motion_animation(arm, trajectory, marked, std::get<0>(given)); });
  return PlayedAnimation(std::move(animation), std::get<1>(given));
}

PlayedAnimation played_motion_among(const CollisionModel& model, const Trajectory& trajectory,
                                    nb::handle waypoints, nb::handle program, nb::handle arrivals,
                                    const nb::kwargs& keywords) {
  const std::vector<Pose> marked = waypoints_from(model.arm(), waypoints);
  const std::optional<FollowedProgram> followed = followed_from(program, arrivals);
  const auto given = options<ArmFigureOptions, PlaybackOptions>(keywords);
  Animation animation = without_lock([&] {
    return drawn_among(model, trajectory, followed, [&](const auto& drawn) {
      return motion_animation(drawn, trajectory, marked, std::get<0>(given));
    });
  });
  return PlayedAnimation(std::move(animation), std::get<1>(given));
}

constexpr const char* model_doc = "The arm among obstacles.";

void bind_chapter(nb::module_& m) {
  const Signature figures(
      "chapter_figures", "list[str]",
      "The figures of Dellaert, *Serial Link Manipulators*, that chapter_figure() draws.");
  define(
      m, [] { return Value<std::vector<std::string>>::to(chapter_figures()); }, figures);
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

/// The arguments of a picture of a motion, of an arm or of a model.
Signature& takes_motion(Signature& signature, bool among_obstacles) {
  signature
      .takes(among_obstacles ? "model" : "arm", among_obstacles ? "CollisionModel" : arm_like,
             among_obstacles ? model_doc : "The arm.")
      .takes("trajectory", "Trajectory", "Of this arm's joints.")
      .takes("waypoints", std::string(arm_poses_like) + " | None",
             "Poses (N, 4, 4) to mark, numbered from 1; of a planar arm also (N, 3), x, y, theta "
             "each.",
             "None");
  if (!among_obstacles) return signature;
  return signature
      .takes("program", "Program | None",
             "The program that the trajectory follows, whose parts are drawn where they are "
             "carried.",
             "None")
      .takes("arrivals", "Sequence[int] | None", arrivals_doc, "None");
}

void bind_motion_figures(nb::module_& m) {
  Signature among("motion_figure", "Picture",
                  "Draws a motion among the obstacles of a model, with the shapes of the links at "
                  "the end and at the closest approach of 201 times, where it draws the line "
                  "between the nearest points.");
  takes_motion(among, true).options<ArmFigureOptions>();
  define(m, &motion_picture_among, among.overloaded(), nb::arg("model"), nb::arg("trajectory"),
         nb::arg("waypoints") = nb::none(), nb::arg("program") = nb::none(),
         nb::arg("arrivals") = nb::none(), nb::arg("options"));
  Signature figure("motion_figure", "Picture", comment("motion_figure"));
  takes_motion(figure, false).options<ArmFigureOptions>();
  define(m, &motion_picture, figure, nb::arg("arm"), nb::arg("trajectory"),
         nb::arg("waypoints") = nb::none(), nb::arg("options"));

  const auto moving = [](bool among_obstacles) {
    Signature signature(
        "motion_animation", "Animation",
        "Draws the same in motion: the arm moves and leaves the trail of its tool.");
    takes_motion(signature, among_obstacles).options<ArmFigureOptions>().options<PlaybackOptions>();
    return signature;
  };
  define(m, &played_motion_among, moving(true).overloaded(), nb::arg("model"),
         nb::arg("trajectory"), nb::arg("waypoints") = nb::none(), nb::arg("program") = nb::none(),
         nb::arg("arrivals") = nb::none(), nb::arg("options"));
  define(m, &played_motion, moving(false), nb::arg("arm"), nb::arg("trajectory"),
         nb::arg("waypoints") = nb::none(), nb::arg("options"));
}

void bind_charts(nb::module_& m) {
  Signature timing("timing_figure", "Picture", comment("timing_figure"));
  timing.takes_arm()
      .takes("motion", "Trajectory | PathMotion", "Of this arm's joints.")
      .keywords()
      .member<&TimingFigureOptions::title>()
      .takes("task", "str | None", "Default: planar for planar arms, else spatial.", "None")
      .takes("tolerance", "Deviation | None", "Drawn as a reference line.", "None")
      .takes("waypoint_times", array_like, comment("TimingFigureOptions::waypoint_times"), "()")
      .takes("clearance", "ClearanceOverTime | None", comment("TimingFigureOptions::clearance"),
             "None");
  define(
      m,
      [](const Arm& arm, nb::handle motion, nb::handle title, nb::handle task, nb::handle tolerance,
         nb::handle waypoint_times, nb::handle clearance) {
        TimingFigureOptions given;
        given.title = Value<std::string>::from(title, "title");
        if (!task.is_none()) given.task = task_of(arm, task);
        given.waypoint_times = Value<std::vector<double>>::from(waypoint_times, "waypoint_times");
        given.clearance = Value<std::optional<ClearanceOverTime>>::from(clearance, "clearance");
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
      nb::arg("waypoint_times") = nb::make_tuple(), nb::arg("clearance") = nb::none());
  Signature responses("step_response_figure", "Picture", comment("step_response_figure"));
  responses.takes("motions", "collections.abc.Mapping[str, Trajectory]", "By the curves' names.")
      .takes("goal", array_like, "Configuration (n,).")
      .takes("title", "str", "Title.", "''");
  define(
      m,
      [](nb::handle motions, nb::handle goal, nb::handle title) {
        if (!nb::isinstance<nb::dict>(motions)) raise_type("motions", "a dict", motions);
        std::vector<NamedMotion> named;
        for (const auto& [name, motion] : nb::borrow<nb::dict>(motions)) {
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
  const auto figure = [](const char* name, const char* type, const char* doc, const char* summary) {
    Signature signature("arm_figure", "Picture", summary);
    signature.takes(name, type, doc)
        .takes("q", std::string(array_like) + " | None",
               "Configuration (n,). Default: `display_configuration(arm)`.", "None")
        .options<ArmFigureOptions>();
    return signature;
  };
  define(m, &arm_picture<CollisionModel>,
         figure("model", "CollisionModel", model_doc,
                "Draws the arm of a model among its obstacles, with the shapes of "
                "its links and a line between the nearest points of the pair with the least "
                "distance beyond its clearance.")
             .overloaded(),
         nb::arg("model"), nb::arg("q") = nb::none(), nb::arg("options"));
  define(m, &arm_picture<Arm>, figure("arm", arm_like, "The arm.", comment("arm_figure")),
         nb::arg("arm"), nb::arg("q") = nb::none(), nb::arg("options"));
  Signature shown(
      "display_configuration", array_type,
      "Returns a configuration (n,) that shows the arm well: the middle of the position limits or, "
      "where the arm is singular there, one far from singularities.");
  shown.takes_arm();
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
  // Notebooks draw an arm, an arm among obstacles, and the joints of a trajectory over time.
  auto arm = nb::borrow<nb::class_<Arm>>(nb::type<Arm>());
  arm.def("_repr_svg_", [](const Arm& self) {
    return notebook_svg(compose(arm_figure(self, display_configuration(self))));
  });
  auto model = nb::borrow<nb::class_<CollisionModel>>(nb::type<CollisionModel>());
  model.def("_repr_svg_", [](const CollisionModel& self) {
    return notebook_svg(compose(arm_figure(self, display_configuration(self.arm()))));
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
