#include <beeline/error.h>
#include <beeline/io/internal/pose_table.h>
#include <beeline/io/internal/time_column.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/pose_form.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/trajectory/internal/joint_columns.h>

namespace beeline::internal {
namespace {

/// The names in the header of a table without the columns of times; none if there is no header.
std::vector<std::string> header_of(std::string_view front, const std::string& path) {
  try {
    CsvLines lines(front, path);
    const CsvRows rows(lines, path, {{}, names_pose});
    std::vector<std::string> names = rows.columns();
    std::erase_if(names, [](const std::string& name) { return names_times({name}); });
    return names;
  } catch (const Error&) {
    return {};  // the reader of recordings has named the mistake
  }
}

}  // namespace

void refuse_poses(std::string_view front, const std::string& path, const Arm& arm) {
  const std::string joints = ", not values of the joints " + listed(arm.joint_names());
  const std::string plans = "; `beeline line --through` plans a trajectory of it";
  if (is_program(front)) {
    throw FileError(path, 0, "is a program: it has moves" + joints + plans);
  }
  const std::vector<std::string> names = header_of(front, path);
  if (names.empty() || names_all_joints(arm, names) || !names_pose(names)) return;
  throw FileError(path, 0,
                  "has poses of the tool, " + listed(names) + joints + plans +
                      ", `beeline batch ik` computes joint values");
}

}  // namespace beeline::internal
