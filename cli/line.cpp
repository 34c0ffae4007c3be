#include <fmt/format.h>
#include <memory>

#include <beeline/control/cartesian.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/move_along.h>
#include <beeline/planning/program.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "command/progress.h"
#include "controlled_line.h"
#include "line_report.h"
#include "path_argument.h"
#include "pose_argument.h"
#include "profile_argument.h"
#include "program_argument.h"
#include "recover_argument.h"
#include "sampling_argument.h"
#include "verbs.h"
#include "work_frame.h"

namespace beeline::command {
namespace {

const std::string exact_method = "exact";

struct LineArguments {
  ArmArgument arm;
  LimitsArgument limits;
  UnitArgument unit;
  TaskArgument task;
  WorkArgument work;
  PathArgument path;
  ProfileArgument profile;
  InterpolationArgument interpolation;
  std::string from, through, method = exact_method;
  PathMotionOptions motion;
  RecoverArgument recover;
  std::optional<double> tool_speed, rate;
  SceneArgument scene;
  BudgetArgument budget;
  CartesianOptions control;
  ResultFiles files;
  bool branches = false;
};

PathMotionOptions exact_motion_options(const LineArguments& arguments, const Task& task) {
  PathMotionOptions options = arguments.motion;
  options.task = task;
  options.profile = arguments.profile.read();
  options.interpolation = arguments.interpolation.read();
  options.suggest = true;
  if (arguments.tool_speed) options.tool_speed = *arguments.tool_speed;
  if (arguments.rate) options.rate = *arguments.rate;
  return options;
}

/// What the plans of a path and of a program have in common.
template <class Motion>
LineReport report_of(const LineArguments& arguments, Motion& motion) {
  LineReport report;
  report.status = motion.status;
  report.reason = std::move(motion.reason);
  if (report.status == MotionStatus::too_many_samples) {
    report.options = {arguments.rate ? "--rate" : "--tolerance", "--max-samples"};
  }
  report.trajectory = std::move(motion.trajectory);
  report.deviation = motion.deviation;
  report.limits = motion.limits;
  report.limit_margin = motion.limit_margin;
  report.inverse_condition = motion.inverse_condition;
  report.recovery = motion.recovery;
  return report;
}

/// A scene in which motions are proved to keep their clearance, and the reports of the first motion
/// that does, of the first one that does not, and of the one that begins with a recovery.
struct ProvedScene {
  const LineArguments& arguments;
  const CheckedScene& scene;
  const std::optional<Configuration>& start;  ///< of --from, also where a motion begins later
  std::optional<ClearanceReport> kept = std::nullopt, refused = std::nullopt;
  std::optional<ClearanceReport> recovering = std::nullopt;

  Reason blocked(const Trajectory& motion, const Budget& budget) {
    ClearanceReport report = arguments.scene.prove_from(start, scene, motion, budget);
    Reason reason = report.proof.reason;
    const bool recovers = recovery_of(scene.model.arm(), motion).has_value();
    std::optional<ClearanceReport>& first = recovers ? recovering : reason ? refused : kept;
    if (!first) first = std::move(report);
    return reason;
  }
};

LineReport line_by_plan(const LineArguments& arguments, const Arm& arm,
                        const std::optional<Configuration>& start, const std::vector<Pose>& poses,
                        const Task& task, const CheckedScene* scene) {
  Progress progress;
  PathMotionOptions options = exact_motion_options(arguments, task);
  options.recover = arguments.recover.read(arm, arguments.unit);
  options.budget = progress.of(arguments.budget.next());
  std::optional<ProvedScene> proved;
  if (scene != nullptr) {
    proved.emplace(ProvedScene{arguments, *scene, start});
    options.blocked_by = blocked_motions(scene->model);
    options.blocked_by.reason = [&proved](const Trajectory& motion, const ClearanceOptions& asked) {
      return proved->blocked(motion, asked.budget);
    };
    options.recover_clearance = arguments.scene.recover_clearance.value_or(0);
  }
  const Route route = start ? arguments.path.from(tool_after_recovery(arm, *start), poses, task)
                            : arguments.path.through(poses);
  PathMotion motion = move_along(arm, start, route, options);
  const Deviation tolerance{options.tolerance, options.orientation_tolerance};
  LineReport report = report_of(arguments, motion);
  report.path_parameter = motion.path_parameter;
  report.nearby = std::move(motion.nearby);
  report.blocked = std::move(motion.blocked);
  // Where none is given, a motion that is kept is of a nearby path.
  const bool reached = report.status == MotionStatus::reached;
  if (proved) report.clearance = std::move(reached ? proved->kept : proved->refused);
  // What was kept first is the motion without its recovery.
  if (proved && proved->recovering) report.clearance = std::move(proved->recovering);
  if (!reached && report.clearance) report.clearance->add_search_ending(report.reason);
  if (reached) {
    report.path = {std::move(motion.path), std::move(motion.path_parameters), task, tolerance,
                   poses};
  }
  if (arguments.branches) {
    report.branches = branch_map(
        arm, route.path, {.task = task, .tolerance = tolerance, .budget = arguments.budget.next()});
  }
  return report;
}

LineReport line_by_program(const LineArguments& arguments, const Arm& arm,
                           const std::optional<Configuration>& start, const Program& program,
                           const Task& task, const CheckedScene* scene) {
  Progress progress;
  PathMotionOptions options = exact_motion_options(arguments, task);
  options.recover = arguments.recover.read(arm, arguments.unit);
  options.recover_clearance = arguments.scene.recover_clearance.value_or(0);
  options.budget = progress.of(arguments.budget.next());
  ProgramMotion motion = at_rows(program, arguments.through, [&] {
    return move_program(arm, start, program, options, scene != nullptr ? &scene->model : nullptr);
  });
  LineReport report = report_of(arguments, motion);
  report.program = program;
  report.moves = std::move(motion.moves);
  report.search_ending = motion.search_ending;
  report.failed = motion.failed;
  return report;
}

std::optional<Configuration> start_of(const LineArguments& arguments, const Arm& arm) {
  if (arguments.from.empty()) {
    if (arguments.scene.recover_clearance.value_or(0) == 0) return std::nullopt;
    throw Error("--recover-clearance needs --from");
  }
  return arguments.arm.configuration(arm, arguments.from, "--from", arguments.unit);
}

LineReport line_by_method(const LineArguments& arguments, const Arm& arm, const Task& task,
                          const std::vector<Pose>& waypoints, const CheckedScene* scene) {
  const std::optional<Configuration> start = start_of(arguments, arm);
  if (arguments.method == exact_method) {
    return line_by_plan(arguments, arm, start, waypoints, task, scene);
  }
  if (!start) throw Error("--method " + arguments.method + " needs --from");
  CartesianOptions options = arguments.control;
  options.task = task;
  options.simulation.budget = arguments.budget.next();
  options.method = arguments.method == name(CartesianMethod::inverse_jacobian)
                       ? CartesianMethod::inverse_jacobian
                       : CartesianMethod::inverse_kinematics;
  return line_by_control(arm, *start, waypoints, options);
}

/// Plans the poses or the program of a file in the frame of --work; `waypoints` becomes the poses
/// in the world, for a picture.
LineReport line_through(const LineArguments& arguments, const Arm& arm, const Task& task,
                        const WorkFrame& frame, const CheckedScene* scene,
                        std::vector<Pose>& waypoints) {
  const std::string text = read_file(arguments.through);
  if (!is_program(text)) {
    waypoints =
        waypoints_from(text, arguments.through, arm, arguments.task, arguments.work, arguments.unit)
            .poses;
    return line_by_method(arguments, frame.arm, task, frame.seen(waypoints), scene);
  }
  if (arguments.method != exact_method || arguments.branches) {
    throw Error((arguments.branches ? "--branches" : "--method " + arguments.method) +
                " is for files of poses; " + arguments.through + " is a program");
  }
  if (arguments.motion.duration) {
    throw Error("--duration is for files of poses; " + arguments.through +
                " is a program, whose rows have speeds");
  }
  const std::optional<Configuration> start = start_of(arguments, arm);
  const Program program = program_from(
      text, arguments.through, arm, {arguments.arm, arguments.task, arguments.work, arguments.unit},
      arguments.path, start ? std::optional(tool_after_recovery(arm, *start)) : std::nullopt);
  check_scene_to_plan(program, arguments.through, scene != nullptr);
  waypoints = waypoints_of(arm, program);
  return line_by_program(arguments, frame.arm, start, frame.seen(program), task, scene);
}

/// The frame of the positions of a refusal's reason: a scene stands in the world.
PositionFrame positions_of_reason(const LineReport& report, const WorkFrame& frame) {
  const bool in_scene = report.clearance && !report.clearance->proof;
  return in_scene && frame.positions != PositionFrame::only ? PositionFrame::world
                                                            : frame.positions;
}

/// The program of a report; without moves if there is none.
FollowedProgram program_of(const LineReport& report, const LineArguments& arguments) {
  FollowedProgram followed{.program = report.program, .file = arguments.through};
  for (const PlannedMove& move : report.moves) followed.arrivals.push_back(move.end);
  return followed;
}

/// Proves that the motion of a program or a controller keeps its clearance, or refuses it.
void prove_clearance_of(LineReport& report, const LineArguments& arguments,
                        const CheckedScene& scene, const WorkFrame& frame) {
  const Budget budget = arguments.budget.next();
  const SceneArgument& proving = arguments.scene;
  report.clearance = report.moves.empty() ? proving.prove(scene, report.trajectory, budget)
                                          : proving.prove(scene, report.trajectory,
                                                          program_of(report, arguments), budget);
  if (report.clearance->proof) return;
  report.status = report.clearance->refusal();
  report.reason = report.clearance->proof.reason;
  if (const ReasonValue* const move = report.reason.find(ReasonField::move)) {
    report.failed = std::get<std::size_t>(*move) - 1;
  }
  report.positions = positions_of_reason(report, frame);
}

Answer line(const LineArguments& arguments) {
  std::vector<std::string> inputs = arguments.scene.inputs();
  inputs.push_back(arguments.through);
  arguments.files.check(arguments.arm.inputs(inputs));
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  const std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, arm);
  const Task task = arguments.task.read(arm);
  const WorkFrame frame(arm, task, arguments.work, arguments.unit);
  std::vector<Pose> waypoints;
  LineReport report =
      line_through(arguments, arm, task, frame, scene ? &*scene : nullptr, waypoints);
  report.method = arguments.method;
  report.waypoints = waypoints.size();
  if (report.status != MotionStatus::reached) {
    report.positions = positions_of_reason(report, frame);
  } else if (scene && !report.clearance) {
    prove_clearance_of(report, arguments, *scene, frame);
  }
  const bool reached = report.status == MotionStatus::reached;
  const Program& program = report.program;
  const std::vector<std::size_t> arrivals = program_of(report, arguments).arrivals;
  const bool carries = report.clearance && !program.attachments.empty();
  std::vector<ProgramScene> scenes;
  if (carries && !arguments.files.draw.empty()) {
    scenes = program_scenes(scene->model, report.trajectory, program, arrivals);
  }
  if (report.clearance) arguments.files.draw_refusal(*report.clearance, scenes);
  if (reached) {
    TimingFigureOptions plot{.path = report.path};
    for (const std::size_t end : arrivals) {
      plot.waypoint_times.push_back(report.trajectory.times[end]);
    }
    if (carries && !arguments.files.plot.empty()) {
      plot.clearance = clearance_over_time(scene->model, report.trajectory, program, arrivals,
                                           arguments.budget.next());
    }
    arguments.files.write(arm, report.trajectory, waypoints, plot, frame.arm,
                          scene ? &scene->model : nullptr, scenes);
  }
  return {.text = report_text(arm, report, arguments.unit, arguments.files),
          .document = report_document(arm, report, arguments.unit, arguments.files),
          .yes = reached,
          .reason = reason_text(report)};
}

std::vector<Option> line_options(LineArguments& arguments) {
  const std::string jacobian = name(CartesianMethod::inverse_jacobian);
  const std::string kinematics = name(CartesianMethod::inverse_kinematics);
  return {through_option("The poses to pass.", &arguments.through), arguments.work.option(),
          joint_values_option("--from",
                              "Joint values at the start. Default: the joint values at the first "
                              "pose that are best for the whole path.",
                              &arguments.from, {"start"}),
          Option("--method METHOD",
                 "exact: a planned motion with a certificate; inverse-jacobian: feedback by the "
                 "inverse Jacobian (eq. 1.6 of the chapter); inverse-kinematics: joint control "
                 "(eq. 1.3) between solutions at intermediate poses.",
                 &arguments.method, {.choices = {exact_method, jacobian, kinematics}})};
}

std::vector<Option> exact_options(LineArguments& arguments) {
  PathMotionOptions& motion = arguments.motion;
  return joined(
      {arguments.path.options({exact_method}),
       {arguments.profile.option({exact_method}), arguments.interpolation.option({exact_method}),
        tool_speed_option(&arguments.tool_speed, "; of a program, in moves without a speed",
                          {exact_method}),
        rate_option(&arguments.rate,
                    ", from the first to the last: each section from stop to stop lasts a whole "
                    "number of periods. Default: as few samples as the motion needs.",
                    {exact_method}),
        duration_option(&motion.duration,
                        ", of a file of poses: the quickest one is slowed down to it", "--rate",
                        {exact_method})},
       path_tolerance_options(&motion.tolerance, &motion.orientation_tolerance,
                              {.range = {.lowest = min_tolerance}, .methods = {exact_method}}),
       {max_samples_option(&motion.max_samples, "more samples are needed.", {exact_method}),
        arguments.recover.option(
            "Accept a --from slightly outside the position limits: a first section leads straight "
            "in joint space to the nearest configuration within them, where the path or program "
            "begins. `beeline check` needs the same option.",
            {.methods = {exact_method}, .needs = "--from"}),
        Option("--branches",
               "Also list every inverse-kinematics branch at the first pose: how many segments it "
               "follows, its margins, and why it ends.",
               &arguments.branches, {.methods = {exact_method}})}});
}

std::vector<Option> control_options(LineArguments& arguments) {
  const std::string jacobian = name(CartesianMethod::inverse_jacobian);
  const std::string kinematics = name(CartesianMethod::inverse_kinematics);
  CartesianOptions& control = arguments.control;
  return joined(
      {{Option("--gain K", "Proportional gain K_p.", &control.gain,
               {.range = above_zero, .methods = {jacobian, kinematics}})},
       step_options(&control.simulation.time_step, &control.simulation.max_steps,
                    {jacobian, kinematics}),
       {Option("--intermediate N", "Poses on each line at which inverse kinematics is solved.",
               &control.intermediate, {.range = {1, 100'000}, .methods = {kinematics}})}});
}

}  // namespace

Verb line_verb() {
  const auto arguments = std::make_shared<LineArguments>();
  return {
      .name = "line",
      .summary = "Move the tool in straight lines through poses, with a proved deviation",
      .description =
          "Plans a joint trajectory whose tool follows straight lines (or --path, --blend) through "
          "the poses of a file, at rest at each pose, in minimum time within the joint limits. "
          "Prints a status, the number of samples and the duration in seconds; the deviation from "
          "the path in metres and radians, measured and proved; the fraction of each joint limit "
          "that is used; and the smallest margins to position limits and singularities. If the "
          "path cannot be followed, it prints where and why, and nearby paths that can; exit code "
          "1.\n\n" +
          std::string(program_help) +
          "With --scene or --self the planned motion must keep a clearance, see `beeline help "
          "check`; otherwise no motion is written, the status is collides or not_decided, "
          "and --draw shows the arm where it collides. "
          "Without --from the best branch that keeps it is taken, and those that do not are "
          "listed as blocked, with what they hit and where or why they end early. A redundant arm "
          "moves aside by self-motion, also with --from. A program has one motion. The tool's path "
          "stays as it is; joint motions are planned around obstacles, see `beeline help "
          "move`.\n\n"
          "If --time-limit or Ctrl-C ends it, it prints how far the path was followed.",
      .arguments = {arguments->arm.argument()},
      .options =
          joined({line_options(*arguments), arguments->unit.options(), arguments->task.options(),
                  arguments->scene.options(), arguments->files.options(), arguments->arm.options(),
                  arguments->limits.options(), exact_options(*arguments),
                  control_options(*arguments), arguments->budget.options()}),
      .examples =
          {{"Three straight lines of the planar arm, with a picture",
            "printf 'x,y,theta\\n4.5,5.2,0\\n2,6,45\\n5,3,-20\\n' > planar.csv\n"
            "beeline line rrr --from 0,90,0 --degrees --through planar.csv --out move.csv --draw "
            "move.svg"},
           {"A Franka Panda with blended corners, sampled at 250 Hz",
            "printf 'x,y,z,roll,pitch,yaw\\n0.5,-0.2,0.5,180,0,0\\n0.5,0.2,0.4,180,0,20\\n"
            "0.4,0.1,0.5,180,0,0\\n' > poses.csv\n"
            "beeline line panda --degrees --through poses.csv --blend 0.02 --rate 250 --out "
            "panda.csv"},
           {"A pick as a program: a joint move to 0.1 m above, down, 0.5 s at rest, and back",
            "printf 'motion,relative,x,y,z,roll,pitch,yaw,speed,dwell\\n"
            "joint,next,0,0,-0.1,0,0,0,,\\nline,,0.5,0.2,0.15,180,0,0,0.1,0.5\\n"
            "line,previous,0,0,-0.1,0,0,0,0.25,\\n' > pick.csv\n"
            "beeline line panda --from 0,-45,0,-135,0,90,45 --degrees --through pick.csv --out "
            "pick_motion.csv\n"
            "beeline check panda pick_motion.csv --degrees --through pick.csv"},
           {"The same lines by feedback, to compare the deviation",
            "beeline line rrr --from 0,90,0 --degrees --through planar.csv --method "
            "inverse-jacobian --gain 0.5"}},
      .run = [arguments] { return line(*arguments); }};
}

}  // namespace beeline::command
