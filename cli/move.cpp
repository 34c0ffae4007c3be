#include <fmt/core.h>

#include <beeline/control/joint.h>
#include <beeline/kinematics/forward.h>

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
  ResultFiles files;
  bool json = false;
};

Exit move(const Arguments& arguments) {
  arguments.files.check({arguments.arm.text});
  const Arm arm = arguments.arm.read();
  const Configuration from = arguments.unit.configuration(arm, arguments.from, "--from");
  const Configuration to = arguments.unit.configuration(arm, arguments.to, "--to");
  const ControlledMotion motion = control_joints(arm, from, to, arguments.gains, arguments.options);
  const bool reached = motion.status == MotionStatus::reached;
  const Pose goal = forward_kinematics(arm, to);
  if (reached) arguments.files.write(arm, motion.trajectory, {goal});

  if (arguments.json) {
    OrderedJson document{{"status", name(motion.status)},
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
    fmt::print("{} after {} steps of {} s\n", name(motion.status), motion.steps,
               shown(arguments.options.time_step));
    fmt::print("error         {} (largest joint error, rad or m)\n", shown(motion.error));
    fmt::print("overshoot     {} % of the way\n", shown(100 * motion.overshoot));
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
  verb.add_option("--kp,--gain", gains.kp, "Proportional gain K_p (eq. 1.3): overshoots above 1")
      ->capture_default_str();
  verb.add_option("--ki", gains.ki, "Integral gain")->capture_default_str();
  verb.add_option("--kd", gains.kd, "Derivative gain")->capture_default_str();
  verb.add_option("--tolerance", options.tolerance, "Joint error that counts as arrived, rad or m")
      ->capture_default_str();
  verb.add_option("--time-step", options.time_step, "Seconds a step")->capture_default_str();
  verb.add_option("--most-steps", options.most_steps, "Steps after which to give up")
      ->capture_default_str();
  arguments.files.declare(verb);
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline move rrr --from 0,0,0 --to 99.2,-68.8,-30.4 --degrees --draw move.svg\n"
      "  beeline move rrr --from 0,0,0 --to 1,1,1 --gain 1.5   (overshoots)\n"
      "  beeline move panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --to 0.5,0,0,-2,0,2,0 --out m.csv");
  return [] { return move(arguments); };
}
