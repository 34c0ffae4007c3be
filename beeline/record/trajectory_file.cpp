#include <beeline/error.h>
#include <beeline/read/internal/file.h>
#include <beeline/read/internal/file_stream.h>
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

TrajectoryFormat trajectory_format(const std::string& path, std::string_view text) {
  if (internal::extension(path).empty()) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const bool brace = first != std::string_view::npos && text[first] == '{';
    return brace ? TrajectoryFormat::json : TrajectoryFormat::csv;
  }
  try {
    return trajectory_format(path);
  } catch (const Error&) {
    throw FileError(path, 0, "is not a known kind of trajectory file; known are .csv, .json");
  }
}

std::string trajectory_text(const Trajectory& trajectory, TrajectoryFormat format) {
  return format == TrajectoryFormat::csv ? internal::trajectory_to_csv(trajectory)
                                         : internal::trajectory_to_json(trajectory);
}

void write_trajectory(const std::string& path, const Trajectory& trajectory) {
  internal::write_file(path, trajectory_text(trajectory, trajectory_format(path)));
}

Trajectory read_trajectory(const std::string& path) {
  trajectory_format(path, "");  // refuses another ending before the file is read
  internal::InputFile file(path);
  constexpr std::size_t begin = 4096;  // of a file without an ending
  return trajectory_format(path, file.peek(begin)) == TrajectoryFormat::csv
             ? internal::trajectory_from_csv(file)
             : internal::trajectory_from_json(file);
}

Trajectory parse_trajectory(std::string_view text, const std::string& path) {
  return trajectory_format(path, text) == TrajectoryFormat::csv
             ? internal::trajectory_from_csv(text, path)
             : internal::trajectory_from_json(text, path);
}

}  // namespace beeline
