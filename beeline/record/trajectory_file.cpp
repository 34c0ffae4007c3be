#include <beeline/error.h>
#include <beeline/read/file.h>
#include <beeline/read/name.h>
#include <beeline/record/trajectory_csv.h>
#include <beeline/record/trajectory_file.h>
#include <beeline/record/trajectory_json.h>

namespace beeline {

TrajectoryFormat trajectory_format(const std::string& path) {
  const std::string ending = extension(path);
  if (ending == "csv") return TrajectoryFormat::csv;
  if (ending == "json") return TrajectoryFormat::json;
  throw Error("trajectories are kept in .csv or .json files, not in " + in_quotes(path));
}

std::string trajectory_text(const Trajectory& trajectory, TrajectoryFormat format) {
  return format == TrajectoryFormat::csv ? trajectory_to_csv(trajectory)
                                         : trajectory_to_json(trajectory);
}

void write_trajectory(const std::string& path, const Trajectory& trajectory) {
  write_file(path, trajectory_text(trajectory, trajectory_format(path)));
}

Trajectory read_trajectory(const std::string& path) {
  const TrajectoryFormat format = trajectory_format(path);
  const std::string text = read_file(path);
  return format == TrajectoryFormat::csv ? trajectory_from_csv(text, path)
                                         : trajectory_from_json(text, path);
}

}  // namespace beeline
