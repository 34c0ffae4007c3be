#include <beeline/error.h>
#include <beeline/read/internal/file.h>
#include <beeline/read/internal/name.h>
#include <beeline/record/internal/trajectory_csv.h>
#include <beeline/record/internal/trajectory_json.h>
#include <beeline/record/trajectory_file.h>

namespace beeline {

TrajectoryFormat trajectory_format(const std::string& path) {
  const std::string ending = internal::extension(path);
  if (ending == "csv") return TrajectoryFormat::csv;
  if (ending == "json") return TrajectoryFormat::json;
  throw Error("trajectories are .csv or .json files, not " + internal::in_quotes(path));
}

std::string trajectory_text(const Trajectory& trajectory, TrajectoryFormat format) {
  return format == TrajectoryFormat::csv ? internal::trajectory_to_csv(trajectory)
                                         : internal::trajectory_to_json(trajectory);
}

void write_trajectory(const std::string& path, const Trajectory& trajectory) {
  internal::write_file(path, trajectory_text(trajectory, trajectory_format(path)));
}

Trajectory read_trajectory(const std::string& path) {
  const TrajectoryFormat format = trajectory_format(path);
  const std::string text = internal::read_file(path);
  return format == TrajectoryFormat::csv ? internal::trajectory_from_csv(text, path)
                                         : internal::trajectory_from_json(text, path);
}

}  // namespace beeline
