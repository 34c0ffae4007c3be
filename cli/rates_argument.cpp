#include "rates_argument.h"

#include <fmt/format.h>

#include <beeline/error.h>
#include <beeline/io/text/numbers.h>
#include <beeline/kinematics/manipulability.h>

#include "command/streams.h"
#include "format.h"
#include "json_reason.h"

namespace beeline::command {
namespace {

/// The velocity as typed, its angular rows in rad/s.
Eigen::VectorXd velocity_from(const std::string& text, const Task& task, const UnitArgument& unit) {
  const std::vector<double> given = parse_numbers(text, "--rates-of");
  if (static_cast<int>(given.size()) != task.size()) {
    throw Error(fmt::format("--rates-of has {}; the rows of the task are {}",
                            counted(static_cast<std::int64_t>(given.size()), "number"),
                            listed(row_names({task.rows, Frame::base}))));
  }
  Eigen::VectorXd velocity =
      Eigen::Map<const Eigen::VectorXd>(given.data(), static_cast<Eigen::Index>(given.size()));
  for (Eigen::Index i = task.positions(); i < velocity.size(); ++i) {
    velocity[i] = to_radians(velocity[i], unit.angle_unit());
  }
  return velocity;
}

/// A velocity of the tool with its angular rows in the unit of the output.
Eigen::VectorXd shown_velocity(Eigen::VectorXd velocity, const Task& task,
                               const UnitArgument& unit) {
  for (Eigen::Index i = task.positions(); i < velocity.size(); ++i) {
    velocity[i] = unit.shown(velocity[i]);
  }
  return velocity;
}

/// Warns of each joint rate above its limit; returns them for the document.
Json excesses_of(const Arm& arm, const JointRates& found, const UnitArgument& unit) {
  Json excesses = Json::list();
  for (const RateExcess& excess : found.excesses) {
    const Joint& joint = arm.joint_of(excess.coordinate);
    const double rate = unit.shown(arm, excess.coordinate, excess.rate);
    const double limit = unit.shown(arm, excess.coordinate, excess.limit);
    const char* length_or_angle = kind(joint) == JointKind::prismatic ? "m" : unit.name();
    warn(
        fmt::format("{} exceeds its velocity limit: {} {}/s, the limit is {}; all joints keep "
                    "theirs at {} times the velocity of the tool",
                    joint.name, number(rate), length_or_angle, number(limit), number(found.scale)));
    excesses.append({{"joint", joint.name}, {"rate", rate}, {"limit", limit}});
  }
  return excesses;
}

/// The names of the joints of these coordinates.
std::vector<std::string> names_of(const Arm& arm, const std::vector<int>& coordinates) {
  std::vector<std::string> names;
  for (const int k : coordinates) names.push_back(arm.joint_of(k).name);
  return names;
}

std::string rates_text(const Arm& arm, const JointRates& found, const Task& task,
                       const UnitArgument& unit) {
  const char* angle = unit.name();
  std::string text =
      fmt::format("joint rates      {}   ({}; {}/s, of a prismatic joint m/s)\n",
                  shown(unit.shown(arm, found.rates)), name(found.status), angle) +
      fmt::format("tool velocity    {}   (J dq; m/s and {}/s)\n",
                  shown(shown_velocity(found.tool_velocity, task, unit)), angle) +
      fmt::format("residual         {}   (|J dq - v|; m/s and rad/s)\n", shown(found.residual));
  if (!found.without_limit.empty()) {
    text += fmt::format("not compared     {}   (their velocity limits are not known)\n",
                        listed(names_of(arm, found.without_limit)));
  }
  for (const auto& direction : found.lost_directions.colwise()) {
    text +=
        fmt::format("lost direction   {}   ({}; m/s and rad/s)\n",
                    shown(Eigen::VectorXd(direction)), listed(row_names({task.rows, Frame::base})));
  }
  return text;
}

}  // namespace

std::vector<Option> RatesArgument::options() {
  return {
      Option("--rates-of TWIST",
             "Velocity of the tool in --frame, one number for each row of --task: m/s, and rad/s "
             "or, with --degrees, deg/s. Prints the joint rates that give it, of a redundant arm "
             "the smallest; at a singularity that prevents it the direction that is lost, with "
             "exit code 1. Rates above the velocity limits give warnings; joints whose velocity "
             "limit is not known are named, as their rates are not compared.",
             &text),
      Option("--damping LAMBDA",
             "Joint rates by damped least squares, which stay small near singularities, and the "
             "velocity of the tool that they give: minimise |J dq - v|^2 + LAMBDA^2 |dq|^2.",
             &damping, {.range = above_zero, .needs = "--rates-of"})};
}

void RatesArgument::add_to(Answer& answer, const Arm& arm, const Configuration& q, const Task& task,
                           const UnitArgument& unit) const {
  if (text.empty()) return;
  const Eigen::VectorXd velocity = velocity_from(text, task, unit);
  const JointRates found = for_option("--rates-of", [&] {
    return joint_rates(arm, q, velocity,
                       {.task = task, .frame = task.frame, .damping = damping.value_or(0)});
  });
  Json lost = Json::list();
  for (const auto& direction : found.lost_directions.colwise()) {
    lost.append(Eigen::VectorXd(direction));
  }
  answer.document.add({{"status", name(found.status)},
                       {"rates", unit.shown(arm, found.rates)},
                       {"tool_velocity", shown_velocity(found.tool_velocity, task, unit)},
                       {"residual", found.residual},
                       {"singular", found.singular},
                       {"lost_directions", lost},
                       {"excesses", excesses_of(arm, found, unit)},
                       {"without_limit", names_of(arm, found.without_limit)},
                       {"scale", found.scale}});
  answer.document.add(json_reason(found.reason));
  const std::string angle = unit.name();
  answer.units.add("rates", angle + "/s, of a prismatic joint m/s");
  answer.units.add("tool_velocity", "m/s, " + angle + "/s");
  answer.units.add("residual", "m/s, rad/s");
  answer.text += rates_text(arm, found, task, unit);
  answer.yes = static_cast<bool>(found);
  answer.reason = sentence(found.reason);
}

}  // namespace beeline::command
