#include "arguments.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/read/arm.h>
#include <beeline/read/internal/numbers.h>
#include <beeline/read/joint_limits.h>

#include "command/streams.h"

using namespace beeline;

namespace {

/// The pose of a frame as typed for `option`: the forms of --pose and, unless the arm is planar,
/// x,y,z without a rotation.
WrittenPose parse_frame(const Arm& arm, const std::string& option, const std::string& text,
                        const UnitArgument& unit) {
  const bool translation = !arm.planar() && std::count(text.begin(), text.end(), ',') == 2;
  return parse_pose_option(option, text + (translation ? ",0,0,0" : ""), unit);
}

}  // namespace

void warn_of_angle(const std::string& option, double angle, const UnitArgument& unit) {
  constexpr double revolution = 2 * std::numbers::pi + 1e-3;  // as typed with four digits
  if (unit.degrees || std::abs(angle) <= revolution) return;
  warn(fmt::format("{}: an angle of {} rad is more than a revolution; --degrees reads degrees",
                   option, number(angle)));
}

std::vector<Option> joined(std::initializer_list<std::vector<Option>> lists) {
  std::vector<Option> all;
  for (const std::vector<Option>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

Positional ArmArgument::argument() {
  return {.name = "ARM",
          .help = "A built-in arm, a joint string or a file (.urdf, .json).",
          .target = &text,
          .completes = Completes::arm};
}

std::vector<Option> ArmArgument::options() {
  return {
      {.name = "--base",
       .value = "LINK",
       .help = "First link of the chain, any link of a URDF file. Default: its root link.",
       .target = &base},
      {.name = "--tip",
       .value = "LINK",
       .help = "Last link of the chain, any link of a URDF file. Default: the leaf that a joint "
               "moves, of several tool0 or, if only fixed joints are between them, the first.",
       .target = &tip},
      {.name = "--tcp",
       .value = "POSE",
       .help = "The tool on the flange: its pose in the arm's own tool frame, as --mount.",
       .target = &tcp},
      {.name = "--mount",
       .value = "POSE",
       .help = "Where the arm stands: the pose of its base in the world, as x,y,theta (planar "
               "arms), x,y,z (other arms), x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz.",
       .target = &mount},
      {.name = "--limits",
       .value = "FILE",
       .help = "Joint limits that replace the arm's: MoveIt's joint_limits.yaml, or .json with "
               "{JOINT: {lower, upper, velocity, acceleration, jerk}, ...}, each optional.",
       .target = &limits,
       .completes = Completes::file}};
}

Arm ArmArgument::read(const UnitArgument& unit) const {
  std::vector<std::string> notes;
  const Arm described = read_arm(text, {.base = base, .tip = tip}, &notes);
  for (const std::string& note : notes) warn(note + "; --tip selects another");
  Arm arm = described;
  if (!tcp.empty()) arm = with_tcp(arm, parse_frame(described, "--tcp", tcp, unit).pose);
  if (!mount.empty()) arm = with_mount(arm, parse_frame(described, "--mount", mount, unit).pose);
  if (limits.empty()) return arm;
  const JointLimits file = read_joint_limits(limits, arm);
  for (const std::string& note : file.notes) warn(note);
  return with_limits(arm, file.joints);
}

Configuration ArmArgument::configuration(const Arm& arm, const std::string& values,
                                         const std::string& option,
                                         const UnitArgument& unit) const {
  return unit.configuration(arm, values, option);
}

std::vector<Option> UnitArgument::options() {
  return {{.name = "--degrees",
           .help = "Read and print angles in degrees instead of radians.",
           .target = &degrees}};
}

Configuration UnitArgument::configuration(const Arm& arm, const std::string& text,
                                          const std::string& option) const {
  const std::vector<double> values = internal::parse_numbers(text, option);
  Configuration q =
      Eigen::Map<const Configuration>(values.data(), static_cast<Eigen::Index>(values.size()));
  if (q.size() != arm.dof()) {
    try {
      check_configuration(arm, q);
    } catch (const Error& error) {
      throw Error(option + ": " + error.what());
    }
  }
  double largest = 0;
  for (int k = 0; k < arm.dof(); ++k) {
    q[k] = coordinate(arm, k, q[k]);
    if (kind(arm.joint_of(k)) == JointKind::prismatic) continue;
    if (std::abs(q[k]) > std::abs(largest)) largest = q[k];
  }
  warn_of_angle(option, largest, *this);
  return q;
}

double UnitArgument::coordinate(const Arm& arm, int k, double value) const {
  const bool prismatic = kind(arm.joint_of(k)) == JointKind::prismatic;
  return prismatic ? value : to_radians(value, angle_unit());
}

double UnitArgument::shown(double radians) const {
  return degrees ? radians * 180 / std::numbers::pi : radians;
}

Configuration UnitArgument::shown(const Arm& arm, const Configuration& q) const {
  Configuration values = q;
  for (int k = 0; k < arm.dof(); ++k) values[k] = shown(arm, k, values[k]);
  return values;
}

double UnitArgument::shown(const Arm& arm, int k, double value) const {
  return kind(arm.joint_of(k)) == JointKind::prismatic ? value : shown(value);
}

std::vector<Option> LimitsArgument::rate_options() {
  const auto option = [](const char* name, const char* value, const char* quantity,
                         std::string* target) -> Option {
    return {.name = name,
            .value = value,
            .help = std::string("Limits of the joints' ") + quantity +
                    ", in place of the arm's: one number for all joints, or one for each.",
            .target = target};
  };
  return {option("--velocity", "V[,V...]", "velocities, rad/s (deg/s with --degrees) or m/s",
                 &velocity),
          option("--acceleration", "A[,A...]", "accelerations, rad/s^2 (deg/s^2) or m/s^2",
                 &acceleration),
          option("--jerk", "J[,J...]", "jerks, rad/s^3 (deg/s^3) or m/s^3", &jerk)};
}

std::vector<Option> LimitsArgument::options() {
  return joined({rate_options(),
                 {{.name = "--speed",
                   .value = "K",
                   .help = "Speed scale k in (0, 1]: velocity limits x k, acceleration x k^2, "
                           "jerk x k^3.",
                   .target = &speed,
                   .range = {1e-6, 1},
                   .phrases = {"the speed scale"}}}});
}

Arm LimitsArgument::set_on(const Arm& arm, const UnitArgument& unit) const {
  std::map<std::string, LimitOverrides> limits;
  const auto add = [&](const std::string& option, const std::string& text,
                       std::optional<double> LimitOverrides::*limit) {
    if (text.empty()) return;
    std::vector<double> values = internal::parse_numbers(text, option);
    if (values.size() == 1) values.resize(static_cast<std::size_t>(arm.dof()), values.front());
    if (static_cast<int>(values.size()) != arm.dof()) {
      throw Error(fmt::format("{} takes one number, or {} ({}), not {}", option, arm.dof(),
                              listed(arm.joint_names()), values.size()));
    }
    for (int k = 0; k < arm.dof(); ++k) {
      const double value = values[static_cast<std::size_t>(k)];
      if (!(value > 0)) throw Error(option + " must be above 0, not " + number(value));
      limits[arm.joint_of(k).name].*limit = unit.coordinate(arm, k, value);
    }
  };
  add("--velocity", velocity, &LimitOverrides::velocity);
  add("--acceleration", acceleration, &LimitOverrides::acceleration);
  add("--jerk", jerk, &LimitOverrides::jerk);
  return with_speed_scale(with_limits(arm, limits), speed);
}

std::vector<Option> TaskArgument::options() {
  return {{.name = "--task",
           .value = "TASK",
           .help = "The components of the tool's pose that count: planar (x, y, theta), position, "
                   "spatial, or six digits 0 or 1 for x y z wx wy wz, such as 111110. A suffix "
                   ":tool takes them along the tool's axes. Default: planar for planar arms, "
                   "otherwise spatial.",
           .target = &text,
           .choices = {"planar", "position", "spatial"},
           .other_values = true}};
}

Task TaskArgument::read(const Arm& arm) const {
  try {
    return text.empty() ? default_task(arm) : task_named(text);
  } catch (const Error& error) {
    throw Error(std::string("--task: ") + error.what());
  }
}

std::vector<Option> JacobianArgument::options() {
  return joined({{{.name = "--frame",
                   .value = "FRAME",
                   .help = "base: velocity of the tool origin in the world's axes; tool: the same "
                           "in the tool's axes; space: spatial twist at the world's origin.",
                   .target = &frame,
                   .choices = {name(Frame::base), name(Frame::tool), name(Frame::space)}}},
                 task.options()});
}

Task JacobianArgument::read(const Arm& arm) const {
  Task rows = task.read(arm);
  if (rows.frame == Frame::tool && frame != name(Frame::tool)) {
    throw Error("--task " + task.text +
                " is in the tool's axes and cannot be combined with --frame " + frame);
  }
  rows.frame = frame_named(frame);
  return rows;
}

Option joint_values_option(std::string name, std::string help, std::string* target,
                           std::vector<std::string> phrases) {
  return {.name = std::move(name),
          .value = "Q",
          .help = std::move(help),
          .target = target,
          .phrases = std::move(phrases)};
}

Option WorkArgument::option() {
  return {.name = "--work",
          .value = "POSE",
          .help = "The frame that poses are given in: its pose in the world, as --mount.",
          .target = &text};
}

WrittenPose WorkArgument::read(const Arm& arm, const UnitArgument& unit) const {
  if (text.empty()) return {.pose = Pose::Identity(), .planar = true};
  return parse_frame(arm, "--work", text, unit);
}

WrittenPose parse_pose_option(const std::string& option, const std::string& text,
                              const UnitArgument& unit) {
  try {
    const WrittenPose written = parse_pose(text, unit.angle_unit());
    warn_of_angle(option, written.max_angle, unit);
    return {checked_pose(written.pose), written.planar};
  } catch (const Error& error) {
    const std::string message = error.what();
    const bool prefixed = message.starts_with("pose:");  // the number's position follows
    throw Error(option + (prefixed ? message.substr(4) : ": " + message));
  }
}

WrittenPose in_world(const WrittenPose& world_T_work, const WrittenPose& pose) {
  return {.pose = world_T_work.pose * pose.pose, .planar = world_T_work.planar && pose.planar};
}

void check_pose_form(const Arm& arm, const WrittenPose& written, const TaskArgument& task) {
  if (written.planar && !arm.planar()) {
    throw Error("x,y,theta is for planar arms; " + arm.name() +
                " needs x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz");
  }
  if (written.planar || !arm.planar() || !task.text.empty()) return;
  constexpr double tolerance = 1e-6;  // metres, and of the unit vector z
  const double height = forward_kinematics(arm, middle_configuration(arm)).translation().z();
  const bool in_plane = std::abs(written.pose.translation().z() - height) < tolerance &&
                        (written.pose.linear().col(2) - Vector3::UnitZ()).norm() < tolerance;
  if (in_plane) return;
  throw Error("the pose is outside the plane z = " + number(height) + " m of arm " + arm.name() +
              "; give x,y,theta, or --task planar to ignore height and tilt");
}

void warn_outside_limits(const Arm& arm, const Configuration& q) {
  for (const std::string& sentence : limit_violations(arm, q)) warn(sentence);
}
