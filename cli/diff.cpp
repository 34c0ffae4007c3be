#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/trajectory/trajectory.h>

#include "arm_argument.h"
#include "motion_report.h"
#include "recording_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct DiffArguments {
  ArmArgument arm;
  std::string a, b;
  RecordingArgument recording;
  UnitArgument unit;
  std::optional<double> tolerance;
};

int joint_of_largest_difference(const Arm& arm, const TrajectoryDifference& difference) {
  int worst = 0;
  for (int k = 1; k < arm.dof(); ++k) {
    if (difference.joints[k].largest > difference.joints[worst].largest) worst = k;
  }
  return worst;
}

Answer diff_files(const DiffArguments& arguments) {
  const double tolerance = arguments.tolerance.value_or(Limits::none);
  const Arm arm = arguments.arm.read(arguments.unit);
  const Recording a = arguments.recording.read_unwrapped(arguments.a, arm, arguments.unit,
                                                         {.joint_map = false, .time_unit = false});
  const Recording b = arguments.recording.read_unwrapped(
      arguments.b, arm, arguments.unit, {.joint_map = !a.mapped, .time_unit = !a.in_time_unit});
  const TrajectoryDifference differences = difference(arm, a.trajectory, b.trajectory);
  const int worst = joint_of_largest_difference(arm, differences);
  const JointDifference& joint = differences.joints[worst];
  const bool within = joint.largest <= tolerance;
  Answer answer{.text = difference_text(arm, differences, arguments.unit),
                .document = {{"status", within ? "within" : "apart"}},
                .yes = within,
                .reason = fmt::format("joint {} differs by {} at {} s; the tolerance is {}",
                                      arm.joint_of(worst).name, number(joint.largest),
                                      number(joint.time), number(tolerance))};
  answer.document.add(difference_members(arm, differences, arguments.unit));
  return answer;
}

}  // namespace

Verb diff_verb() {
  const auto arguments = std::make_shared<DiffArguments>();
  return {.name = "diff",
          .summary = "Compare two recordings of an arm, such as commanded and measured",
          .description =
              "Prints, for each joint, the largest difference, the time at which it occurs and the "
              "root mean square; the same for the tool's position and orientation; and how much "
              "longer the second recording lasts. The first sample of each recording is at time 0; "
              "joints move linearly between samples; of continuous joints whole revolutions do not "
              "count. The comparison ends with the shorter recording. --joint-map is for the "
              "recordings that have its names, --time-unit for tables. " +
              std::string(recording_units),
          .arguments = {arguments->arm.argument(),
                        file_argument("A", "A recorded trajectory, .csv, .json or .yaml.",
                                      &arguments->a),
                        file_argument("B", "Another one, of the same arm.", &arguments->b)},
          .options = joined(
              {arguments->unit.options(),
               arguments->recording.options(),
               {Option("--tolerance E",
                       "Exit with code 1 if a joint differs by more than this, radians or metres.",
                       &arguments->tolerance, {.range = zero_or_more})},
               arguments->arm.options()}),
          .examples = {{"Two gains of joint control, compared",
                        "beeline move rrr --from 0,0,0 --to 1,1,1 --kp 0.1 --out slow.csv\n"
                        "beeline move rrr --from 0,0,0 --to 1,1,1 --kp 0.2 --out fast.csv\n"
                        "beeline diff rrr slow.csv fast.csv --degrees"},
                       {"Equal within 1e-3 rad? (exit code 0)",
                        "beeline diff rrr slow.csv slow.csv --tolerance 1e-3 --json"}},
          .run = [arguments] { return diff_files(*arguments); }};
}

}  // namespace beeline::command
