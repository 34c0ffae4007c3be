#include <atomic>
#include <limits>

#include <beeline/batch/parallel.h>
#include <beeline/batch/shape.h>
#include <beeline/pose/orientation.h>

#include <oneapi/tbb/enumerable_thread_specific.h>

namespace beeline {
namespace {

Pose pose_of(const double* number, PoseLayout layout) {
  if (layout == PoseLayout::matrix) {
    Pose pose;
    pose.matrix() = Eigen::Map<const Eigen::Matrix4d>(number);
    return pose;
  }
  return make_pose({number[0], number[1], number[2]},
                   rotation_from_quaternion(number[3], number[4], number[5], number[6]));
}

}  // namespace

Eigen::Index batch_inverse(const Arm& arm, ConstColumnsRef<double> world_T_tool,
                           ConstColumnsRef<double> seeds, ColumnsRef<double> q,
                           const InverseOptions& inverse, const BatchOptions& options) {
  const Eigen::Index count = world_T_tool.cols();
  check_rows(arm, "world_T_tool", world_T_tool, size(options.layout));
  check_shape(arm, "q", q, arm.dof(), count);
  check_rows(arm, "seeds", seeds, arm.dof());
  if (seeds.cols() != 1) check_shape(arm, "seeds", seeds, arm.dof(), count);

  InverseOptions one = inverse;
  one.all = one.every_turn = false;
  const InverseSolver original(arm, one);
  tbb::enumerable_thread_specific<InverseSolver> solvers(original);
  std::atomic<Eigen::Index> solved = 0;
  constexpr Eigen::Index block = 32;
  in_parallel(count, block, options.threads, [&](Eigen::Index first, Eigen::Index last) {
    InverseSolver& solver = solvers.local();
    Eigen::MatrixXd solution(arm.dof(), 1);
    for (Eigen::Index i = first; i < last; ++i) {
      const auto seed = seeds.col(seeds.cols() == 1 ? 0 : i);
      const double* pose = world_T_tool.data() + i * world_T_tool.outerStride();
      const bool finite = world_T_tool.col(i).allFinite() && seed.allFinite();
      const int found = finite ? solver.solve(pose_of(pose, options.layout), seed, solution) : 0;
      if (found == 0) solution.setConstant(std::numeric_limits<double>::quiet_NaN());
      q.col(i) = solution;
      if (found != 0) ++solved;
    }
  });
  return solved;
}

}  // namespace beeline
