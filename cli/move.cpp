#include <fmt/core.h>

#include <beeline/control/joint.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/timing/point_to_point.h>

#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string from, to;
  PidGains gains;
  SimulationOptions options;
  std::string method = "feedback", synchronise = "time";
  double rate = 100;
  ResultFiles files;
  bool json = false;
  std::vector<const CLI::Option*> feedback_options, quickest_options;
};

/// Refuses an option that the chosen method would ignore.
void check_method(const Arguments& arguments) {
  const bool feedback = arguments.method == "feedback";
  if (!feedback && arguments.method != "quickest") {
    throw unknown_name("method", arguments.method, {"feedback", "quickest"});
  }
  for (const CLI::Option* option :
       feedback ? arguments.quickest_options : arguments.feedback_options) {
    if (option->count() == 0) continue;
    throw Error(option->get_name() + " does not go with --method " + arguments.method);
  }
}

Synchronise synchronise_named(const std::string& name) {
  if (name == "time") return Synchronise::time;
  if (name == "straight") return Synchronise::straight;
  throw unknown_name("synchronisation", name, {"time", "straight"});
}

/// All joints together, as quickly as velocities, accelerations and jerks allow.
ControlledMotion move_quickest(const Arguments& arguments, const Arm& arm,
                               const Configuration& from, const Configuration& to) {
  const PointToPoint motion =
      point_to_point(arm, from, to, {.synchronise = synchronise_named(arguments.synchronise)});
  ControlledMotion result;
  result.trajectory = sampled(arm, motion, arguments.rate);
  result.steps = static_cast<int>(result.trajectory.size()) - 1;
  return result;
}

Exit move(const Arguments& arguments) {
  check_method(arguments);
  arguments.files.check({arguments.arm.text});
  const Arm arm = arguments.arm.read();
  const Configuration from = arguments.unit.configuration(arm, arguments.from, "--from");
  const Configuration to = arguments.unit.configuration(arm, arguments.to, "--to");
  const bool feedback = arguments.method == "feedback";
  const ControlledMotion motion =
      feedback ? control_joints(arm, from, to, arguments.gains, arguments.options)
               : move_quickest(arguments, arm, from, to);
  const bool reached = motion.status == MotionStatus::reached;
  const Pose goal = forward_kinematics(arm, to);
  if (reached) arguments.files.write(arm, motion.trajectory, {goal});

  if (arguments.json) {
    OrderedJson document{{"status", name(motion.status)},
                         {"method", arguments.method},
                         {"samples", motion.trajectory.size()},
                         {"steps", motion.steps},
                         {"error", json_number(motion.error)},
                         {"overshoot", json_number(motion.overshoot)},
                         {"slowed", motion.slowed},
                         {"duration", motion.trajectory.times.back()},
                         {"reason", motion.reason}};
    if (reached) arguments.files.add_to(document);
    print_json(document);
  } else {
    if (feedback) {
      fmt::print("{} after {} steps of {} s\n", name(motion.status), motion.steps,
                 shown(arguments.options.time_step));
      fmt::print("error         {} (largest joint error, rad or m)\n", shown(motion.error));
      fmt::print("overshoot     {} % of the way\n", shown(100 * motion.overshoot));
    } else {
      fmt::print("{} after {} s\n", name(motion.status), shown(motion.trajectory.times.back()));
    }
    if (motion.slowed > 0) {
      fmt::print("slowed        {} steps, to keep the velocity limits\n", motion.slowed);
    }
    if (reached) {
      fmt::print("tool at the goal\n");
      print_pose(goal, arm.planar(), arguments.unit);
      arguments.files.print();
    }
  }
  if (!reached) fmt::print(stderr, "beeline: {}\n", motion.reason);
  return reached ? Exit::yes : Exit::no;
}

}  // namespace

Run declare_move(CLI::App& verb) {
  static Arguments arguments;
  PidGains& gains = arguments.gains;
  SimulationOptions& options = arguments.options;
  arguments.arm.declare(verb);
  verb.add_option("--from", arguments.from, "Joint values at the start")->required();
  verb.add_option("--to", arguments.to, "Joint values at the goal")->required();
  arguments.unit.declare(verb);
  verb.add_option(
          "--method", arguments.method,
          "feedback: the chapter's control (eq. 1.3), P or PID; quickest: a plan, jerk-limited\n"
          "where the arm has limits of jerk, all joints beginning and ending together")
      ->capture_default_str();
  arguments.feedback_options = {
      verb.add_option("--kp,--gain", gains.kp,
                      "feedback: proportional gain K_p (eq. 1.3): overshoots above 1")
          ->capture_default_str(),
      verb.add_option("--ki", gains.ki, "feedback: integral gain")->capture_default_str(),
      verb.add_option("--kd", gains.kd, "feedback: derivative gain")->capture_default_str(),
      verb.add_option("--tolerance", options.tolerance,
                      "feedback: joint error that counts as arrived, rad or m")
          ->capture_default_str(),
      verb.add_option("--time-step", options.time_step, "feedback: seconds a step")
          ->capture_default_str(),
      verb.add_option("--most-steps", options.max_steps, "feedback: steps after which to give up")
          ->capture_default_str()};
  arguments.quickest_options = {
      verb.add_option(
              "--synchronise", arguments.synchronise,
              "quickest: time, each joint on a law of its own, or straight, all in proportion")
          ->capture_default_str(),
      verb.add_option("--rate", arguments.rate, "quickest: samples a second")
          ->capture_default_str()};
  arguments.files.declare(verb);
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline move rrr --from 0,0,0 --to 99.2,-68.8,-30.4 --degrees --draw move.svg\n"
      "  beeline move rrr --from 0,0,0 --to 1,1,1 --gain 1.5   (overshoots)\n"
      "  beeline move panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --to 0.5,0,0,-2,0,2,0 --out m.csv\n"
      "  beeline move panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --to 0.5,0,0,-2,0,2,0 "
      "--method quickest --rate 1000");
  return [] { return move(arguments); };
}
