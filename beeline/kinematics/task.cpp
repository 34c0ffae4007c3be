#include <algorithm>
#include <ostream>
#include <utility>

#include <beeline/error.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/kinematics/task.h>

namespace beeline {
namespace {

/// Names that take the suffix :tool.
constexpr std::pair<const char*, Task (*)()> rows_by_name[] = {
    {"planar", Task::planar}, {"position", Task::position}, {"spatial", Task::spatial}};

/// Names that state their axes: tasks without one rotation, about an axis of the tool or of the
/// world.
constexpr std::pair<const char*, Task> tasks_by_name[] = {
    {"direction", {{true, true, true, true, true, false}, Frame::tool}},
    {"direction:x", {{true, true, true, false, true, true}, Frame::tool}},
    {"direction:y", {{true, true, true, true, false, true}, Frame::tool}},
    {"approach:xy", {{true, true, true, true, true, false}, Frame::base}},
    {"approach:xz", {{true, true, true, true, false, true}, Frame::base}},
    {"approach:yz", {{true, true, true, false, true, true}, Frame::base}},
};

/// All names, each with a comma behind it.
std::string listed_names() {
  std::string text;
  for (const auto& named : rows_by_name) text += std::string(named.first) + ", ";
  for (const auto& named : tasks_by_name) text += std::string(named.first) + ", ";
  return text;
}

}  // namespace

void check_task(const Task& task) {
  if (task.size() > 0 && task.frame != Frame::space) return;
  throw Error(task.frame == Frame::space
                  ? "the frame is space; this is computed in the axes of the base or of the tool"
                  : "the task needs at least one row, in the axes of the base or of the tool");
}

int Task::size() const { return static_cast<int>(std::count(rows.begin(), rows.end(), true)); }

Task task_named(std::string_view text) {
  for (const auto& [known, task] : tasks_by_name) {
    if (text == known) return task;
  }
  Task task;
  std::string_view mask = text;
  const std::string_view suffix = ":tool";
  if (mask.ends_with(suffix)) {
    task.frame = Frame::tool;
    mask.remove_suffix(suffix.size());
  }
  for (const auto& [known, rows] : rows_by_name) {
    if (mask != known) continue;
    task.rows = rows().rows;
    return task;
  }
  const bool planar = mask.size() == 3;
  const bool is_mask = (planar || mask.size() == 6) &&
                       mask.find_first_not_of("01") == std::string_view::npos &&
                       mask.find('1') != std::string_view::npos;
  if (!is_mask) {
    throw Error("unknown task \"" + std::string(text.substr(0, 40)) +
                "\"; known: " + listed_names() +
                "six of 0 and 1 for x y z wx wy wz such as 111010, or three for x y theta such as "
                "110, with the suffix :tool for rows in the tool's axes");
  }
  task.rows.fill(false);
  constexpr std::array<std::size_t, 3> planar_rows{0, 1, 5};
  for (std::size_t i = 0; i < mask.size(); ++i) {
    task.rows[planar ? planar_rows[i] : i] = mask[i] == '1';
  }
  return task;
}

Task task_named(std::string_view text, const Arm& arm) {
  const Task task = task_named(text);
  const bool is_planar_mask = text.substr(0, text.find(':')).size() == 3;  // no name is so short
  if (!is_planar_mask || arm.planar()) return task;
  throw Error("the mask \"" + std::string(text) + "\" of x, y and theta is for planar arms; arm " +
              arm.name() +
              " is not planar: write position for x, y, z, or six of 0 and 1 for x y z "
              "wx wy wz such as 111000");
}

std::string name(const Task& task) {
  for (const auto& [known, named] : tasks_by_name) {
    if (task == named) return known;
  }
  std::string text;
  for (const auto& [known, rows] : rows_by_name) {
    if (task.rows == rows().rows) text = known;
  }
  if (text.empty()) {
    for (const bool row : task.rows) text += row ? '1' : '0';
  }
  return text + (task.frame == Frame::tool ? ":tool" : "");
}

std::ostream& operator<<(std::ostream& out, const Task& task) { return out << name(task); }

std::ostream& operator<<(std::ostream& out, const Deviation& deviation) {
  return out << number(deviation.position) << " m, " << number(deviation.orientation) << " rad";
}

Task default_task(const Arm& arm) { return arm.planar() ? Task::planar() : Task::spatial(); }

std::vector<std::string> row_names(const Task& task) {
  if (task == Task::planar()) return {"x", "y", "theta"};
  constexpr std::array names{"vx", "vy", "vz", "wx", "wy", "wz"};
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < 6; ++i) {
    if (task.rows[i]) kept.emplace_back(names[i]);
  }
  return kept;
}

Eigen::VectorXd task_rows(const Task& task, const Twist& twist) {
  Eigen::VectorXd kept(task.size());
  int row = 0;
  for (int i = 0; i < 6; ++i) {
    if (task.rows[i]) kept[row++] = twist[i];
  }
  return kept;
}

Eigen::MatrixXd selected_rows(const Task& task, const Eigen::Ref<const Jacobian>& columns) {
  Eigen::MatrixXd kept(task.size(), columns.cols());
  int row = 0;
  for (int i = 0; i < 6; ++i) {
    if (task.rows[i]) kept.row(row++) = columns.row(i);
  }
  return kept;
}

Eigen::MatrixXd task_jacobian(const Arm& arm, const ConfigurationRef& q, const Task& task,
                              double length_unit) {
  if (!(length_unit > 0)) {
    throw Error("length_unit is " + number(length_unit) + " m; it must be above 0");
  }
  Jacobian all = jacobian(arm, q, task.frame);
  all.topRows<3>() /= length_unit;
  return selected_rows(task, all);
}

Eigen::MatrixXd task_jacobian(const Arm& arm, const ConfigurationRef& q) {
  return task_jacobian(arm, q, default_task(arm));
}

Twist pose_error(const Pose& desired, const Pose& current, Frame frame) {
  Twist error = pose_difference(desired, current);
  if (frame == Frame::tool) {
    const Rotation tool_R_world = current.linear().transpose();
    error << tool_R_world * error.head<3>(), tool_R_world * error.tail<3>();
  }
  return error;
}

Eigen::VectorXd task_error(const Task& task, const Pose& desired, const Pose& current) {
  return task_rows(task, pose_error(desired, current, task.frame));
}

std::string deviation_text(const Deviation& deviation) {
  return number(deviation.position) + " m and " + angle(deviation.orientation);
}

Deviation task_deviation(const Task& task, const Pose& desired, const Pose& current) {
  const Twist error = internal::masked(task, pose_error(desired, current, task.frame));
  return {error.head<3>().norm(), error.tail<3>().norm()};
}

}  // namespace beeline
