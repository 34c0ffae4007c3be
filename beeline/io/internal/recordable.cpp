#include <unordered_set>

#include <beeline/error.h>
#include <beeline/io/internal/recordable.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_joints = 10'000;  // check_trajectory() compares all pairs of names

}  // namespace

void check_recordable(const Trajectory& trajectory) {
  if (trajectory.joint_names.empty() && trajectory.size() == 0) {
    throw Error(
        "the trajectory is empty, as after a motion that was refused: see its status and reason");
  }
  if (trajectory.joint_names.empty()) throw Error("the trajectory has no joints");
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  std::unordered_set<std::string> names;
  for (const std::string& name : trajectory.joint_names) {
    check_name(name, "a joint's name");
    if (!names.insert(name).second) {
      throw Error("two joints of the trajectory have the name " + in_quotes(name));
    }
  }
  if (names.size() > max_joints) {
    throw Error("the trajectory has " + std::to_string(names.size()) + " joints; at most " +
                std::to_string(max_joints) + " are accepted");
  }
  check_trajectory(trajectory);
}

}  // namespace beeline::internal
