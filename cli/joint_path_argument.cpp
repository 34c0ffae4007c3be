#include "joint_path_argument.h"

#include <beeline/error.h>

#include "arguments.h"
#include "sampling_argument.h"

namespace beeline::command {

std::vector<Option> JointPathArgument::options(const std::string& quickest,
                                               const std::string& other) {
  const std::vector<std::string> methods = {quickest, other};
  std::vector<Option> reading = recording.reading_options();
  std::erase_if(reading, [](const Option& option) { return option.name == "--time-unit"; });
  for (Option& option : reading) option.needs = "--through";
  Option profile_option = profile.option(methods);
  Option speed = tool_speed_option(&tool_speed, "", methods);
  for (Option* option : {&profile_option, &speed}) {
    option->help += " With --method " + quickest + " it needs --through.";
  }
  std::vector<Option> own{
      Option("--through FILE",
             "Configurations that the quickest motion passes after --from, without a stop, up to "
             "the last, where it ends; instead of --to. A .csv file with a row for each, with "
             "or without the joints' names, or a trajectory whose times are ignored.",
             &through, {.methods = {quickest}}),
      joint_blend_option(&joint_blend,
                         "with --through the path is the cubic spline through the "
                         "configurations; with --method around the blends are as large as the "
                         "clearance allows.",
                         methods),
      profile_option,
      speed,
      duration_option(&duration,
                      ", with --to a whole number of periods of --rate, otherwise without a rate",
                      "", methods),
      rate_option(&rate, ". Default: 100; with --through as few samples as the motion needs.",
                  methods)};
  return joined({own, reading});
}

std::vector<Configuration> JointPathArgument::waypoints(const Arm& arm,
                                                        const UnitArgument& unit) const {
  RecordingArgument reading = recording;
  if (unit.degrees && reading.angle_unit.empty()) reading.angle_unit = name(JointUnit::degrees);
  return matched_to(arm, reading.read(through, arm, unit, {.times = false}).trajectory).positions;
}

RetimeOptions JointPathArgument::through_options() const {
  return {.profile = profile.read(),
          .joint_blend = joint_blend,
          .tool_speed = tool_speed.value_or(Limits::none),
          .rate = rate.value_or(0),
          .duration = duration};
}

void JointPathArgument::set_on(FreeMotionOptions& options) const {
  if (joint_blend) options.joint_blend = *joint_blend;
  options.profile = profile.read();
  options.tool_speed = tool_speed.value_or(Limits::none);
  options.rate = rate.value_or(duration ? 0 : default_rate);
  options.duration = duration;
}

void JointPathArgument::refuse_without_through() const {
  const char* given = joint_blend             ? "--joint-blend"
                      : tool_speed            ? "--tool-speed"
                      : !profile.text.empty() ? "--profile"
                                              : nullptr;
  if (given == nullptr) return;
  throw Error(std::string(given) + " needs --through or --method around");
}

}  // namespace beeline::command
