#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include <beeline/control/joint.h>
#include <beeline/error.h>
#include <beeline/io/text/numbers.h>
#include <beeline/kinematics/forward.h>

#include "arm_argument.h"
#include "around_argument.h"
#include "budget_argument.h"
#include "command/streams.h"
#include "format.h"
#include "gain_comparison.h"
#include "joint_path_argument.h"
#include "json_reason.h"
#include "motion_report.h"
#include "recover_argument.h"
#include "result_files.h"
#include "retimed_answer.h"
#include "sampling_argument.h"
#include "scene_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

const std::string feedback = "feedback", quickest = "quickest", around = AroundArgument::method;

struct MoveArguments {
  ArmArgument arm;
  LimitsArgument limits;
  UnitArgument unit;
  std::string from, to;
  PidGains gains;
  std::string kp = "0.1";  ///< one number or several
  SimulationOptions simulation;
  SceneArgument scene;
  BudgetArgument budget;
  std::string method = feedback, synchronise = "time";
  RecoverArgument recover;
  JointPathArgument path;
  AroundArgument around;
  ResultFiles files;
};

/// The motion in minimum time or in --duration, all joints beginning and ending together.
ControlledMotion move_quickest(const MoveArguments& arguments, const Arm& arm,
                               const Configuration& from, const Configuration& to,
                               const Budget& budget) {
  const Synchronise synchronise =
      arguments.synchronise == "time" ? Synchronise::time : Synchronise::straight;
  JointMoveOptions options{.synchronise = synchronise,
                           .rate = arguments.path.rate.value_or(JointPathArgument::default_rate),
                           .duration = arguments.path.duration,
                           .budget = budget};
  if (arguments.recover.given()) options.recover = arguments.recover.read(arm, arguments.unit);
  const ControlledMotion motion = move_joints(arm, from, to, options);
  if (arguments.recover.given()) return motion;
  for (const Reason& outside : limit_violations(arm, from)) {
    warn("--from: " + sentence(outside) + "; the motion leads back in");
  }
  return motion;
}

std::string tool_text(const MoveArguments& arguments, const Arm& arm, const Pose& goal) {
  return "tool at the goal\n" + pose_text(goal, arguments.arm.shown_in_plane(arm), arguments.unit);
}

std::string move_text(const MoveArguments& arguments, const Arm& arm,
                      const ControlledMotion& motion, const Pose& goal) {
  std::string text;
  if (arguments.method == feedback) {
    text = fmt::format("{} after {} of {} s\n", name(motion.status), counted(motion.steps, "step"),
                       shown(arguments.simulation.time_step)) +
           fmt::format("error         {} (largest joint error, rad or m)\n", shown(motion.error)) +
           fmt::format("overshoot     {} of the distance\n", percent(motion.overshoot));
  } else {
    const bool refused =
        motion.status == MotionStatus::collides || motion.status == MotionStatus::not_decided;
    text = name(motion.status) + (refused ? ": a motion of " : " after ") +
           shown(motion.trajectory.times.back()) + " s\n";
  }
  if (motion.slowed > 0) {
    text += fmt::format("slowed        {}, to respect the velocity limits\n",
                        counted(motion.slowed, "step"));
  }
  if (!motion) return text;
  text += recovery_text(arm, motion.recovery, arguments.unit) + position_text(motion.limits) +
          limits_text(motion.limits) + start_jump_text(arm, motion.start_jump, arguments.unit);
  return text + tool_text(arguments, arm, goal);
}

/// The proportional gains as typed.
std::vector<double> gains_of(const MoveArguments& arguments) {
  const std::string option = "--gain (--kp)";
  std::vector<double> gains = parse_numbers(arguments.kp, option);
  for (const double gain : gains) {
    if (!(gain > 0)) throw Error(option + " must be above 0, not " + number(gain));
  }
  constexpr std::size_t max_gains = 32;
  if (gains.size() > max_gains) {
    throw Error(option + " takes at most 32 gains, not " + std::to_string(gains.size()));
  }
  return gains;
}

/// One simulation for each gain.
Answer compare_gains(const MoveArguments& arguments, const Arm& arm, const Configuration& from,
                     const Configuration& to, const std::vector<double>& gains) {
  if (arguments.scene.given()) throw Error("--scene and --self are for one gain");
  if (!arguments.files.out.empty() || !arguments.files.plot.empty()) {
    throw Error("several gains make one picture, --draw; --out and --plot are for one gain");
  }
  constexpr double max_total = 1e7;  // steps of all gains, which the picture keeps in memory
  if (static_cast<double>(gains.size()) * arguments.simulation.max_steps > max_total) {
    throw Error(fmt::format("--max-steps of {} gains must be at most {}, not {}", gains.size(),
                            static_cast<int>(max_total / static_cast<double>(gains.size())),
                            arguments.simulation.max_steps));
  }
  std::vector<GainMotion> motions;
  for (const double gain : gains) {
    SimulationOptions simulation = arguments.simulation;
    simulation.budget = arguments.budget.next();
    PidGains pid = arguments.gains;
    pid.kp = gain;
    motions.push_back({gain, control_joints(arm, from, to, pid, simulation)});
  }
  return compared_gains(motions, to, arguments.files.draw);
}

/// Warns of two neighbouring waypoints that are much closer than others, such as a position taught
/// twice: the spline through both needs large accelerations there, and its duration grows.
void warn_of_twins(const std::vector<Configuration>& waypoints) {
  constexpr double much_closer = 1e-3;  // of the median distance
  std::vector<double> distances;
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    distances.push_back((waypoints[k] - waypoints[k - 1]).norm());
  }
  std::vector<double> sorted = distances;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  for (std::size_t k = 0; k < distances.size(); ++k) {
    if (distances[k] == 0 || distances[k] > much_closer * median) continue;
    const std::string first = k == 0 ? "--from" : fmt::format("configuration {}", k);
    return warn(
        fmt::format("--through: {} and configuration {} are {} apart; the spline through "
                    "both takes long: leave one out, or use --joint-blend",
                    first, k + 1, number(distances[k])));
  }
}

/// The quickest motion through the configurations of --through.
Answer move_through_file(const MoveArguments& arguments, const Arm& arm, const Configuration& from,
                         const std::optional<CheckedScene>& scene) {
  std::vector<Configuration> waypoints = arguments.path.waypoints(arm, arguments.unit);
  waypoints.insert(waypoints.begin(), from);
  RetimeOptions options = arguments.path.through_options();
  options.recover = arguments.recover.read(arm, arguments.unit);
  options.budget = arguments.budget.next();
  if (!options.joint_blend) warn_of_twins(waypoints);
  const Retimed retimed = beeline::move_through(arm, waypoints, options);
  RetimedResult result{arguments.scene, scene, arguments.budget, arguments.files, arguments.unit};
  for (const Configuration& q : waypoints) result.waypoints.push_back(forward_kinematics(arm, q));
  Answer answer = result.answer(arm, retimed);
  answer.document.add("method", quickest);
  if (!answer.yes) return answer;
  answer.document.add(
      "error", (retimed.trajectory.positions.back() - waypoints.back()).lpNorm<Eigen::Infinity>());
  answer.document.add("tool_at_goal",
                      json_pose(result.waypoints.back(), arm.planar(), arguments.unit));
  answer.units = {{"error", "rad or m"}};
  answer.text += tool_text(arguments, arm, result.waypoints.back());
  return answer;
}

/// The configuration of --to; --pose or --through may be given instead.
std::optional<Configuration> goal_of(const MoveArguments& arguments, const Arm& arm) {
  const bool has_pose = !arguments.around.pose.empty(), has_path = !arguments.path.through.empty();
  const std::string other = has_pose ? "--pose" : has_path ? "--through" : "";
  if (arguments.to.empty() == other.empty()) {
    throw Error(!other.empty() ? "--to and " + other + " are two goals; give one of them"
                               : "move needs --to, the joint values at the goal" +
                                     std::string(arguments.method == around     ? ", or --pose"
                                                 : arguments.method == quickest ? ", or --through"
                                                                                : ""));
  }
  if (!other.empty()) return std::nullopt;
  return arguments.arm.configuration(arm, arguments.to, "--to", arguments.unit);
}

/// Proves that the motion keeps its clearance, writes the files and reports.
Answer proved_answer(const MoveArguments& arguments, const Arm& arm, const Configuration& to,
                     const std::optional<CheckedScene>& scene, ControlledMotion motion) {
  std::optional<ClearanceReport> clearance;
  if (scene && motion) {
    clearance = arguments.scene.prove(*scene, motion.trajectory, arguments.budget.next());
    motion.status = clearance->refusal();
    if (!clearance->proof) motion.reason = clearance->proof.reason;
    arguments.files.draw_refusal(*clearance);
  }
  const bool reached(motion);
  const Pose goal = forward_kinematics(arm, to);
  if (reached) {
    arguments.files.write(arm, motion.trajectory, {goal},
                          {.waypoint_times = {motion.trajectory.times.back()}}, std::nullopt,
                          scene ? &scene->model : nullptr);
  }
  const std::string of_clearance = clearance ? clearance->text() : "";
  Answer answer{
      .text = move_text(arguments, arm, motion, goal) + of_clearance +
              (reached ? arguments.files.text() : ""),
      .document = {{"status", name(motion.status)},
                   {"method", arguments.method},
                   {"samples", motion.trajectory.size()},
                   {"steps", motion.steps},
                   {"error", motion.error},
                   {"overshoot", motion.overshoot},
                   {"slowed", motion.slowed},
                   {"duration", motion.trajectory.times.back()}},
      .units = {{"error", "rad or m"}},
      .yes = reached,
      .reason = clearance && !reached ? clearance->reason_text() : sentence(motion.reason)};
  answer.document.add(json_reason(motion.reason));
  if (reached) {
    answer.document.add("tool_at_goal", json_pose(goal, arm.planar(), arguments.unit));
    answer.document.add("limits", json_limits(motion.limits));
    answer.document.add("start_jump", json_start_jump(arm, motion.start_jump, arguments.unit));
    if (arguments.method == quickest) {
      answer.document.add("recovery", json_recovery(arm, motion.recovery, arguments.unit));
    }
  }
  if (clearance) answer.document.add("clearance", clearance->document());
  if (reached) arguments.files.add_to(answer.document);
  return answer;
}

Answer move_between(const MoveArguments& arguments) {
  std::vector<std::string> inputs = arguments.scene.inputs();
  if (!arguments.path.through.empty()) inputs.push_back(arguments.path.through);
  arguments.files.check(arguments.arm.inputs(inputs));
  const std::vector<double> gains = gains_of(arguments);
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  const Configuration from =
      arguments.arm.configuration(arm, arguments.from, "--from", arguments.unit);
  const std::optional<Configuration> goal_values = goal_of(arguments, arm);
  const std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, arm);
  if (arguments.method == around) {
    if (!scene) throw Error("--method around needs --scene or --self");
    return arguments.around.answer(arm, from, goal_values, arguments.scene, *scene, arguments.unit,
                                   arguments.path, arguments.budget, arguments.files);
  }
  if (!goal_values) return move_through_file(arguments, arm, from, scene);
  arguments.path.refuse_without_through();
  const Configuration& to = *goal_values;
  if (gains.size() > 1) return compare_gains(arguments, arm, from, to, gains);
  SimulationOptions simulation = arguments.simulation;
  simulation.budget = arguments.budget.next();
  PidGains pid = arguments.gains;
  pid.kp = gains.front();
  ControlledMotion motion = arguments.method == feedback
                                ? control_joints(arm, from, to, pid, simulation)
                                : move_quickest(arguments, arm, from, to, simulation.budget);
  return proved_answer(arguments, arm, to, scene, std::move(motion));
}

std::vector<Option> move_options(MoveArguments& arguments) {
  Option from =
      joint_values_option("--from", "Joint values at the start.", &arguments.from, {"start"});
  Option to = joint_values_option("--to", "Joint values at the goal.", &arguments.to);
  from.required = true;
  return {from, to,
          Option("--method METHOD",
                 "feedback: P or PID control of each joint (eq. 1.3 of the chapter); quickest: "
                 "minimum time under the velocity, acceleration and jerk limits, from rest to "
                 "rest; with --to the start may be outside the limits by up to 0.1 rad or m, "
                 "see --recover; "
                 "around: a "
                 "motion from rest to rest around the obstacles of --scene.",
                 &arguments.method, {.choices = {feedback, quickest, around}})};
}

std::vector<Option> feedback_options(MoveArguments& arguments) {
  PidGains& gains = arguments.gains;
  SimulationOptions& simulation = arguments.simulation;
  return joined(
      {{Option("--kp K[,K...]",
               "Proportional gain K_p, per step, above 0; the joints overshoot if it is above 1. "
               "Several gains are compared in one table, and in one picture by --draw.",
               &arguments.kp, {.alias = "--gain", .methods = {feedback}}),
        Option("--ki K", "Integral gain.", &gains.ki,
               {.range = zero_or_more, .methods = {feedback}}),
        Option("--kd K", "Derivative gain.", &gains.kd,
               {.range = zero_or_more, .methods = {feedback}}),
        Option("--tolerance E",
               "The goal is reached when every joint error is below this, rad or m.",
               &simulation.tolerance, {.range = above_zero, .methods = {feedback}})},
       step_options(&simulation.time_step, &simulation.max_steps, {feedback})});
}

std::vector<Option> quickest_options(MoveArguments& arguments) {
  return {Option("--synchronise KIND",
                 "time: each joint has its own profile of the same duration; straight: all joints "
                 "move in proportion, on a straight line in joint space.",
                 &arguments.synchronise,
                 {.choices = {"time", "straight"}, .methods = {quickest}, .excludes = "--through"}),
          arguments.recover.option(
              "Accept a --from slightly outside the position limits: the motion begins with a "
              "return to "
              "them, in which the excess of each joint falls; with --through to the nearest "
              "configuration within them, at rest. `beeline check` needs the same option.",
              {.methods = {quickest}})};
}

}  // namespace

Verb move_verb() {
  const auto arguments = std::make_shared<MoveArguments>();
  return {
      .name = "move",
      .summary = "Joint-space motion control from one configuration to another",
      .description =
          "Simulates proportional or PID control of the joints, or plans the quickest motion. "
          "Prints a status, the number of steps, the largest joint error at the end in rad or "
          "m, the overshoot, the largest fraction of each joint limit, and the pose of the tool "
          "at the goal. Control respects limits of position and velocity alone: its motion begins "
          "with a "
          "jump of velocity, which is printed too; the quickest motion begins at rest and "
          "respects all limits. In general the tool does "
          "not move in a straight line: see `beeline line`. With --scene or --self the motion "
          "must keep a clearance, see `beeline help check`; otherwise no motion is written, and "
          "the status is collides or not_decided.\n\n"
          "--method around searches a path around the obstacles: the straight joint motion first, "
          "then two trees of random configurations that grow towards each other (RRT-Connect). The "
          "path is shortened and proved to keep the clearance, its waypoints are passed in "
          "blends, and the finished motion is proved. If none is found (not_found), "
          "one may exist.",
      .arguments = {arguments->arm.argument()},
      .options =
          joined({move_options(*arguments), arguments->unit.options(), arguments->scene.options(),
                  arguments->files.options(), arguments->arm.options(), arguments->limits.options(),
                  feedback_options(*arguments), quickest_options(*arguments),
                  arguments->path.options(quickest, around), arguments->around.options(),
                  arguments->budget.options()}),
      .examples =
          {{"Proportional control of the planar arm, with a picture of the tool's path",
            "beeline move rrr --from 0,0,0 --to 99.2,-68.8,-30.4 --degrees --draw move.svg"},
           {"A gain above 1 overshoots", "beeline move rrr --from 0,0,0 --to 1,1,1 --kp 1.5"},
           {"Gains side by side: too small is slow, too large overshoots",
            "beeline move rrr --from 0,0,0 --to 99.2,-68.8,-30.4 --degrees --gain "
            "0.05,0.1,0.5,1,1.5 --draw gains.svg"},
           {"The quickest motion of a Franka Panda at 1 kHz",
            "beeline move panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --to 0.5,0,0,-2,0,2,0 --method "
            "quickest --rate 1000 --out move.csv"},
           {"Through configurations without a stop, at most 0.1 rad off the straight joint motions",
            "printf '40,20,-20\\n60,10,10\\n60,60,10\\n' > through.csv\n"
            "beeline move rrr --from 0,90,0 --degrees --method quickest --through through.csv "
            "--joint-blend 0.1 --out through_motion.csv"},
           {"Around an obstacle, with a proof",
            "printf '{\"obstacles\": [{\"name\": \"pillar\", \"shapes\": [{\"cylinder\": "
            "{\"radius\": "
            "0.06, \"length\": 1.2}, \"pose\": {\"xyz\": [0.45, 0, 0.5]}}]}]}' > pillar.json\n"
            "beeline move panda --from 0.6,-0.3,0,-2.2,0,1.9,0.8 --to=-0.6,-0.3,0,-2.2,0,1.9,0.8 "
            "--method around --scene pillar.json --out around.csv"}},
      .run = [arguments] { return move_between(*arguments); }};
}

}  // namespace beeline::command
