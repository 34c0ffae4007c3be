#include "arguments.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/numbers.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include "command/streams.h"

namespace beeline::command {

void warn_of_angle(const std::string& option, double angle, const UnitArgument& unit) {
  warn_of_angle(option, angle, std::nullopt, unit);
}

void warn_of_angle(const std::string& option, double angle, std::optional<PoseForm> form,
                   const UnitArgument& unit) {
  const auto note = angle_note(angle, form, unit.pose_format());
  if (note) warn(sentence(*note, option, OptionStyle::command));
}

std::vector<Option> joined(std::initializer_list<std::vector<Option>> lists) {
  std::vector<Option> all;
  for (const std::vector<Option>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

std::vector<std::string> items_of(std::string_view list, char separator) {
  std::vector<std::string> items(1);
  for (const char letter : list) {
    if (letter == separator) {
      items.emplace_back();
    } else {
      items.back() += letter;
    }
  }
  return items;
}

std::vector<Option> UnitArgument::options() {
  return {Option("--degrees", "Read and print angles in degrees instead of radians.", &degrees),
          Option("--millimetres",
                 "Read and print positions of poses in millimetres instead of metres. Joint "
                 "values, tolerances and all other lengths stay in metres.",
                 &millimetres),
          Option("--pose-form FORM",
                 "How poses are typed and printed: rpy, x,y,z,roll,pitch,yaw; rotvec, "
                 "x,y,z,rx,ry,rz, always in radians; abc, x,y,z,A,B,C of KUKA, always in degrees; "
                 "quaternion, x,y,z,qw,qx,qy,qz; matrix, m11,m12,...,m44 row by row, 16 numbers or "
                 "the first 12. Default: by the number of numbers, six are rpy. The header of a "
                 "file names its own form, and p[x,y,z,rx,ry,rz] is a pose of URScript, in metres "
                 "and radians.",
                 &pose_form, {.choices = pose_form_names()})};
}

PoseFormat UnitArgument::pose_format(Triple triple, std::optional<PoseForm> form) const {
  if (!pose_form.empty()) form = pose_form_named(pose_form);
  return {
      .angle_unit = angle_unit(), .triple = triple, .pose_form = form, .millimetres = millimetres};
}

Vector3 UnitArgument::shown_position(const Pose& pose) const {
  return pose.translation() * (millimetres ? 1000 : 1);
}

Configuration UnitArgument::joint_rates(const Arm& arm, const std::string& text,
                                        const std::string& option) const {
  const std::vector<double> values = parse_numbers(text, option);
  Configuration q =
      Eigen::Map<const Configuration>(values.data(), static_cast<Eigen::Index>(values.size()));
  if (q.size() != arm.dof()) for_option(option, [&] { check_configuration(arm, q); });
  for (int k = 0; k < arm.dof(); ++k) q[k] = coordinate(arm, k, q[k]);
  return q;
}

Configuration UnitArgument::configuration(const Arm& arm, const std::string& text,
                                          const std::string& option) const {
  const Configuration q = joint_rates(arm, text, option);
  double largest = 0;
  for (int k = 0; k < arm.dof(); ++k) {
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
  const auto option = [](const char* heading, const char* quantity, std::string* target) -> Option {
    return {heading,
            std::string("Limits of the joints' ") + quantity +
                ", in place of the arm's: one number for all joints, or one for each.",
            target};
  };
  return {
      option("--velocity V[,V...]", "velocities, rad/s (deg/s with --degrees) or m/s", &velocity),
      option("--acceleration A[,A...]", "accelerations, rad/s^2 (deg/s^2) or m/s^2", &acceleration),
      option("--jerk J[,J...]", "jerks, rad/s^3 (deg/s^3) or m/s^3", &jerk)};
}

std::vector<Option> LimitsArgument::options() {
  return joined(
      {rate_options(),
       {Option("--speed K",
               "Speed scale k in (0, 1]: velocity limits x k, acceleration x k^2, jerk x k^3.",
               &speed, {.range = {1e-6, 1}, .arguments = {"speed_scale"}})}});
}

namespace {

/// Warns where one number in degrees is also in metres.
void warn_of_mixed_units(const std::string& option, const std::string& text, const Arm& arm,
                         const UnitArgument& unit) {
  std::vector<std::string> prismatic;
  for (int k = 0; k < arm.dof(); ++k) {
    const Joint& joint = arm.joint_of(k);
    if (kind(joint) == JointKind::prismatic) prismatic.push_back(joint.name);
  }
  const bool mixed = !prismatic.empty() && static_cast<int>(prismatic.size()) < arm.dof();
  if (!unit.degrees || !mixed) return;
  warn(option + " " + text + " is in degrees for most joints and in metres for " +
       listed(prismatic) + "; give one number for each joint (" + listed(arm.joint_names()) + ")");
}

}  // namespace

Arm LimitsArgument::set_on(const Arm& arm, const UnitArgument& unit) const {
  std::map<std::string, LimitOverrides> limits;
  const auto add = [&](const std::string& option, const std::string& text,
                       std::optional<double> LimitOverrides::*limit) {
    if (text.empty()) return;
    std::vector<double> values = parse_numbers(text, option);
    if (values.size() == 1) {
      warn_of_mixed_units(option, text, arm, unit);
      values.resize(static_cast<std::size_t>(arm.dof()), values.front());
    }
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
  return {
      Option("--task TASK",
             "The components of the tool's pose that count: planar (x, y, theta), position, "
             "spatial; for arms of five joints direction, the position and the direction of "
             "the tool's z axis, direction:x and direction:y of its other axes, or approach:xy, "
             "approach:xz or approach:yz, everything except the rotation about the normal of "
             "this plane of the world; or six digits 0 or 1 for x y z wx wy wz, such as 111010, "
             "or three for x y theta of a planar arm, such as 110. A suffix :tool takes them "
             "along the tool's axes. Default: planar for planar arms, otherwise spatial.",
             &text,
             {.choices = {"planar", "position", "spatial", "direction", "direction:x",
                          "direction:y", "approach:xy", "approach:xz", "approach:yz"},
              .other_values = true})};
}

Task TaskArgument::read(const Arm& arm) const {
  return for_option("--task",
                    [&] { return text.empty() ? default_task(arm) : task_named(text, arm); });
}

std::vector<Option> JacobianArgument::options() {
  return joined({{Option("--frame FRAME",
                         "base: velocity of the tool origin in the world's axes; tool: the same in "
                         "the tool's axes; space: spatial twist at the world's origin. Default: "
                         "tool for a task in the tool's axes, otherwise base.",
                         &frame,
                         {.choices = {name(Frame::base), name(Frame::tool), name(Frame::space)},
                          .other_values = true})},  // frame_named() says what the known ones mean
                 task.options()});
}

Task JacobianArgument::read(const Arm& arm) const {
  Task rows = task.read(arm);
  if (frame.empty()) return rows;
  const Frame wanted = for_option("--frame", [&] { return frame_named(frame); });
  if (rows.frame == Frame::tool && wanted != Frame::tool) {
    throw Error("--task " + task.text +
                " is in the tool's axes and cannot be combined with --frame " + frame +
                "; leave out :tool or --frame");
  }
  rows.frame = wanted;
  return rows;
}

int coordinate_named(const Arm& arm, const std::string& joint, const std::string& option) {
  if (const auto found = coordinate_called(arm, joint)) return *found;
  const std::vector<std::string> names = arm.joint_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (joint != std::to_string(k + 1)) continue;
    throw Error(fmt::format("{}: joints have names, not numbers; joint {} is {} (known: {})",
                            option, joint, names[k], listed(names)));
  }
  throw unknown_name("joint", joint, names).behind(option + ": ");
}

Option joint_values_option(const std::string& name, std::string help, std::string* target,
                           std::vector<std::string> arguments) {
  return {name + " Q", std::move(help), target, {.arguments = std::move(arguments)}};
}

Option threads_option(int* target) {
  return {"--threads N",
          "Number of threads; 0: as many as the machine has. The results do not depend on it.",
          target,
          {.range = {0, 1024}}};
}

Option tool_speed_option(std::optional<double>* target, const std::string& motions,
                         std::vector<std::string> methods) {
  return {"--tool-speed V",
          "Largest speed of the tool origin, m/s" + motions + ".",
          target,
          {.range = tool_speeds, .methods = std::move(methods)}};
}

std::vector<Option> path_tolerance_options(double* position, double* orientation,
                                           const OptionRules& rules) {
  return {
      {"--tolerance METRES", "Largest distance of the tool origin from the path.", position, rules},
      {"--orientation-tolerance RAD", "Largest angle from the path's orientation, radians.",
       orientation, rules}};
}

Positional file_argument(std::string name, std::string help, std::string* target, bool required) {
  return {std::move(name), std::move(help), target, Completes::file, required};
}

Option configuration_option(std::string* target) {
  return {"--q Q",
          "Joint values, comma-separated, from the base on; metres for a prismatic joint.",
          target,
          {.required = true}};
}

void warn_outside_limits(const Arm& arm, const Configuration& q) {
  for (const Reason& outside : limit_violations(arm, q)) warn(sentence(outside));
}

}  // namespace beeline::command
