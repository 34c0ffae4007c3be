#include <unordered_set>

#include <beeline/error.h>
#include <beeline/read/internal/name.h>
#include <beeline/record/internal/recordable.h>

namespace beeline::internal {

void check_recordable(const Trajectory& trajectory) {
  if (trajectory.joint_names.empty()) throw Error("the trajectory has no joints");
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  std::unordered_set<std::string> names;
  for (const std::string& name : trajectory.joint_names) {
    check_name(name, "a joint's name");
    if (!names.insert(name).second) {
      throw Error("two joints of the trajectory have the name " + in_quotes(name));
    }
  }
  check_trajectory(trajectory);
}

}  // namespace beeline::internal
