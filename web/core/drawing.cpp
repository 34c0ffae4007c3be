#include <algorithm>

#include <beeline/draw/arm_figure.h>

#include "arms.h"
#include "beeline.h"
#include "fault.h"

using namespace beeline;

int beeline_skeleton(int arm, const double* q, double* numbers) {
  return web::guarded([&] {
    const Arm& model = web::arm_of(arm);
    const Skeleton line = skeleton(model, web::joint_values(q, model.dof()));
    const auto write = [&numbers](const Vector3& point) {
      Eigen::Map<Vector3>(numbers, 3) = point;
      numbers += 3;
    };
    write(line.base);
    for (const SkeletonJoint& joint : line.joints) {
      *numbers++ = static_cast<double>(joint.kind);
      for (const Vector3& point : {joint.direction, joint.enter, joint.leave, joint.centre}) {
        write(point);
      }
    }
    write(line.tool);
    return static_cast<int>(line.joints.size());
  });
}

int beeline_display_configuration(int arm, double* q) {
  return web::guarded([&] {
    const Configuration chosen = display_configuration(web::arm_of(arm));
    std::copy(chosen.begin(), chosen.end(), q);
    return 0;
  });
}
