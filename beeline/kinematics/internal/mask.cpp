#include <beeline/kinematics/internal/mask.h>

namespace beeline::internal {

Twist masked(const Task& task, Twist twist) {
  for (int i = 0; i < 6; ++i) {
    if (!task.rows[i]) twist[i] = 0;
  }
  return twist;
}

Vector3 masked_position(const Task& task, Vector3 position) {
  for (int i = 0; i < 3; ++i) {
    if (!task.rows[i]) position[i] = 0;
  }
  return position;
}

void mask_rows(const Task& task, Eigen::Ref<Jacobian> columns) {
  for (int i = 0; i < 6; ++i) {
    if (!task.rows[i]) columns.row(i).setZero();
  }
}

}  // namespace beeline::internal
