#include <algorithm>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>

#include "arms.h"
#include "beeline.h"
#include "fault.h"

using namespace beeline;
using web::arm_of;
using web::guarded;
using web::joint_values;

int beeline_forward(int arm, const double* q, double* matrices) {
  return guarded([&] {
    const Arm& model = arm_of(arm);
    const std::vector<Pose> links = link_poses(model, joint_values(q, model.dof()));
    const auto write = [&matrices](const Pose& pose) {
      Eigen::Map<Eigen::Matrix4d>(matrices, 4, 4) = pose.matrix();
      matrices += 16;
    };
    for (const Pose& link : links) write(link);
    write(links.back() * model.tool());
    return 0;
  });
}

int beeline_jacobian(int arm, const double* q, int frame, double* columns) {
  return guarded([&] {
    const Arm& model = arm_of(arm);
    if (frame < 0 || frame > 2) throw Error("a frame is 0 base, 1 tool or 2 space");
    Eigen::Map<Jacobian>(columns, 6, model.dof()) =
        jacobian(model, joint_values(q, model.dof()), static_cast<Frame>(frame));
    return 0;
  });
}

int beeline_manipulability(int arm, const double* q, double* measures) {
  return guarded([&] {
    const Arm& model = arm_of(arm);
    const auto found = manipulability_measures(
        task_jacobian(model, joint_values(q, model.dof()), default_task(model)));
    measures[0] = found.manipulability;
    measures[1] = found.condition;
    std::copy(found.singular_values.begin(), found.singular_values.end(), measures + 2);
    return static_cast<int>(found.singular_values.size());
  });
}

int beeline_inverse(int arm, const double* pose, const double* seed, int ignore_limits,
                    int capacity, double* solutions) {
  return guarded([&] {
    const Arm& model = arm_of(arm);
    if (capacity < 1) throw Error("capacity is " + std::to_string(capacity) + "; it is 1 or more");
    // The default task by name: of a planar arm it ignores the height and tilt of a dragged tool.
    const InverseOptions options{
        .task = default_task(model), .all = capacity > 1, .ignore_limits = ignore_limits != 0};
    Pose world_T_tool;
    world_T_tool.matrix() = Eigen::Map<const Eigen::Matrix4d>(pose, 4, 4);
    Eigen::Map<Eigen::MatrixXd> columns(solutions, model.dof(), capacity);
    return inverse_kinematics(model, world_T_tool, joint_values(seed, model.dof()), columns,
                              options);
  });
}
