#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <span>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/program.h>

#include "animation_argument.h"
#include "arm_argument.h"
#include "pose_argument.h"
#include "program_argument.h"
#include "recording_argument.h"
#include "result_files.h"
#include "scene_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct DrawArguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string motion, q, out, through;
  RecordingArgument recording;
  TaskArgument task;
  WorkArgument work;
  double azimuth = 0, elevation = 0;  ///< degrees
  ArmFigureOptions figure;
  SceneArgument scene;
  AnimationArgument animation;
};

ArmFigureOptions figure_options(const DrawArguments& arguments) {
  ArmFigureOptions options = arguments.figure;
  options.azimuth = to_radians(arguments.azimuth, AngleUnit::degrees);
  options.elevation = to_radians(arguments.elevation, AngleUnit::degrees);
  return options;
}

/// What --through adds to a picture.
struct Followed {
  std::vector<Pose> waypoints = {};       ///< in the world
  std::vector<ProgramScene> scenes = {};  ///< of a program that carries parts, with --scene
};

Followed followed_by(const DrawArguments& arguments, const Arm& arm, const Trajectory& motion,
                     const CollisionModel* model) {
  const std::string& file = arguments.through;
  if (file.empty()) return {};
  const std::string text = read_file(file);
  if (!is_program(text)) {
    return {waypoints_from(text, file, arm, arguments.task, arguments.work, arguments.unit).poses};
  }
  const Program program =
      program_from(text, file, arm, {arguments.arm, arguments.task, arguments.work, arguments.unit},
                   {}, forward_kinematics(arm, motion.positions.front()));
  Followed followed{.waypoints = waypoints_of(arm, program)};
  if (model == nullptr || program.attachments.empty()) return followed;
  at_rows(program, file, [&] {
    const Verification found = verify(arm, motion, program);
    if (found.arrivals.size() < program.moves.size()) {
      throw FileError(file, 0,
                      "attaches parts, and " + arguments.motion +
                          " is no motion of this program: " + sentence(found.reason));
    }
    followed.scenes = program_scenes(*model, motion, program, found.arrivals);
  });
  return followed;
}

/// Draws or animates a motion, by motion_figure() or motion_animation().
template <class Draw>
auto drawn_motion(const Draw& draw, const Arm& arm, const CollisionModel* model,
                  const Followed& followed) {
  if (!followed.scenes.empty()) return draw(std::span<const ProgramScene>(followed.scenes));
  return model != nullptr ? draw(*model) : draw(arm);
}

void draw_motion(const DrawArguments& arguments, const Arm& arm, const CollisionModel* model) {
  if (!arguments.q.empty())
    throw Error("--q cannot be combined with a motion, which has joint values");
  ArmFigureOptions options = figure_options(arguments);
  const Trajectory trajectory =
      arguments.recording.read_unwrapped(arguments.motion, arm, arguments.unit).trajectory;
  if (trajectory.size() == 0) throw FileError(arguments.motion, 0, "has no samples");
  const Followed followed = followed_by(arguments, arm, trajectory, model);
  if (!arguments.out.empty()) {
    const auto draw = [&](const auto& drawn) {
      return motion_figure(drawn, trajectory, followed.waypoints, options);
    };
    write_file(arguments.out,
               render(drawn_motion(draw, arm, model, followed), format_of(arguments.out)));
  }
  if (!arguments.animation.wanted()) return;
  options.small_views = false;
  const auto animate = [&](const auto& drawn) {
    return motion_animation(drawn, trajectory, followed.waypoints, options);
  };
  arguments.animation.write(drawn_motion(animate, arm, model, followed));
}

void draw_configuration(const DrawArguments& arguments, const Arm& arm,
                        const CollisionModel* model) {
  if (arguments.animation.wanted())
    throw Error("--animate needs a motion: beeline draw ARM FILE --animate " +
                arguments.animation.file);
  if (!arguments.through.empty()) throw Error("--through needs a motion: beeline draw ARM FILE");
  Configuration q = display_configuration(arm);
  if (!arguments.q.empty()) {
    q = arguments.arm.configuration(arm, arguments.q, "--q", arguments.unit);
    warn_outside_limits(arm, q);
  }
  const ArmFigureOptions options = figure_options(arguments);
  const Figure figure =
      model != nullptr ? arm_figure(*model, q, options) : arm_figure(arm, q, options);
  write_file(arguments.out, render(figure, format_of(arguments.out)));
}

Answer draw_arm(const DrawArguments& arguments) {
  std::vector<std::string> files = arguments.scene.inputs();
  files.insert(files.end(), {arguments.motion, arguments.through});
  const std::vector<std::string> inputs = arguments.arm.inputs(files);
  if (arguments.out.empty() && !arguments.animation.wanted()) {
    throw Error("draw needs --out PICTURE or, for a motion, --animate FILE");
  }
  if (!arguments.out.empty()) {
    format_of(arguments.out);
    refuse_overwriting(arguments.out, inputs);
  }
  arguments.animation.check(arguments.out, inputs);
  const Arm arm = arguments.arm.read(arguments.unit);
  const std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, arm);
  (arguments.motion.empty() ? draw_configuration : draw_motion)(arguments, arm,
                                                                scene ? &scene->model : nullptr);
  Answer answer{.document = {{"status", "drawn"}}};
  for (const auto& [key, file] :
       {std::pair{"out", arguments.out}, std::pair{"animation", arguments.animation.file}}) {
    if (file.empty()) continue;
    answer.text += fmt::format("{} drawn: {}\n", arm.name(), file);
    answer.document.add(key, file);
  }
  return answer;
}

std::vector<Option> draw_options(DrawArguments& arguments) {
  ArmFigureOptions& figure = arguments.figure;
  return {
      Option("--out FILE", "The picture: .svg, .png or .pdf.", &arguments.out),
      joint_values_option("--q",
                          "Joint values. Default: the middle of the position limits or, where that "
                          "is singular, values far from singularities.",
                          &arguments.q),
      Option("--through FILE",
             "A .csv file of poses or a program (see `beeline help line`), to mark and number its "
             "waypoints in the picture of a motion. With --scene the parts that a program attaches "
             "are drawn where they are carried.",
             &arguments.through),
      arguments.work.option(),
      Option("--frames",
             "Draw the frame of every link: x red, y green, z blue. Of frames at one place the "
             "later is shorter and thicker.",
             &figure.frames),
      Option(
          "--jacobian",
          "Draw the columns of the Jacobian as arrows at the tool: joint 1 red, 2 green, 3 blue.",
          &figure.jacobian),
      Option("--title TEXT", "The title. Default: the arm's name.", &figure.title),
      Option("--azimuth DEGREES",
             "Direction from x to the viewer of a spatial arm, always in degrees.",
             &arguments.azimuth),
      Option("--elevation DEGREES",
             "Height of the viewer of a spatial arm above the ground, always in degrees.",
             &arguments.elevation)};
}

}  // namespace

Verb draw_verb() {
  const auto arguments = std::make_shared<DrawArguments>();
  const UnitArgument degrees{true};
  arguments->azimuth = std::round(degrees.shown(arguments->figure.azimuth));
  arguments->elevation = std::round(degrees.shown(arguments->figure.elevation));
  return {
      .name = "draw",
      .summary = "Draw an arm or a motion: SVG, PNG, PDF, animations",
      .description =
          "Draws the arm at given joint values, or the arm along a trajectory with the path of its "
          "tool. With --animate the arm moves, in real time. Prints the names of the files.\n\n"
          "With --scene or --self it also draws the obstacles, the shapes of the links, and a line "
          "between the two bodies that are nearest to their clearance; of a motion at the closest "
          "of 201 times. `beeline check` proves the clearance at all times.",
      .arguments = {arguments->arm.argument(),
                    file_argument("FILE", "A trajectory of the arm, .csv, .json or .yaml.",
                                  &arguments->motion, false)},
      .options = joined({draw_options(*arguments), arguments->animation.options(),
                         arguments->recording.options(), arguments->unit.options(),
                         arguments->scene.distance_options(), arguments->arm.options()}),
      .examples = {{"The planar arm with the columns of its Jacobian",
                    "beeline draw rrr --q 0,90,0 --degrees --jacobian --out rrr.svg"},
                   {"All frames of a UR5", "beeline draw ur5 --frames --out ur5.pdf"},
                   {"A motion, as a picture and moving",
                    "beeline move panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --to 0.5,0,0,-2,0,2,0 --out "
                    "move.csv\n"
                    "beeline draw panda move.csv --out move.png --animate move.svg"}},
      .run = [arguments] { return draw_arm(*arguments); }};
}

}  // namespace beeline::command
