#pragma once

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline {

/// How a pose is written as numbers of one column.
enum class PoseLayout {
  matrix,               ///< 16: the 4 x 4 matrix, column by column
  position_quaternion,  ///< 7: x y z qw qx qy qz, qw >= 0
};
/// Numbers of a pose: 16 or 7.
int size(PoseLayout layout);

struct BatchOptions {
  PoseLayout layout = PoseLayout::matrix;
  Frame frame = Frame::base;  ///< of Jacobians
  int threads = 0;  ///< 0: as many as the machine has. The results are the same for any number
};

// The kinematics of many configurations, one in each column: `q` is dof x N, radians and metres. A
// numpy array of N rows of dof numbers is the same memory. Real is float or double; with float the
// arithmetic is float too. Eight configurations (sixteen in float) go through the registers
// together, and blocks of them to the threads. The results go into the caller's matrices of N
// columns. Where a number of a column of q is not finite those of its results are not.
// All throw Error when a size does not fit.

template <class Real>
using ColumnsRef = Eigen::Ref<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>;
template <class Real>
using ConstColumnsRef = Eigen::Ref<const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>;

/// The tool's poses: size(layout) x N.
template <class Real>
void batch_forward(const Arm& arm, ConstColumnsRef<Real> q, ColumnsRef<Real> world_T_tool,
                   const BatchOptions& options = {});

/// The poses of links 0 to n, one below the other: (joints + 1) size(layout) x N.
template <class Real>
void batch_link_poses(const Arm& arm, ConstColumnsRef<Real> q, ColumnsRef<Real> world_T_link,
                      const BatchOptions& options = {});

/// The Jacobians, column by column: 6 dof x N; and the tool's poses, unless `world_T_tool` has no
/// columns.
template <class Real>
void batch_jacobian(const Arm& arm, ConstColumnsRef<Real> q, ColumnsRef<Real> jacobians,
                    ColumnsRef<Real> world_T_tool, const BatchOptions& options = {});

/// sqrt(det(J J^T)) of the whole Jacobian, as manipulability(): 1 x N.
template <class Real>
void batch_manipulability(const Arm& arm, ConstColumnsRef<Real> q, ColumnsRef<Real> values,
                          const BatchOptions& options = {});

/// One solution for each pose (size(layout) x N) into `q` (dof x N), from the seeds: dof x N, or
/// dof x 1 for all. Where there is none the column of q is NaN. Returns how many were solved.
/// `inverse.all` and `inverse.every_turn` do not count.
Eigen::Index batch_inverse(const Arm& arm, ConstColumnsRef<double> world_T_tool,
                           ConstColumnsRef<double> seeds, ColumnsRef<double> q,
                           const InverseOptions& inverse = {}, const BatchOptions& options = {});

}  // namespace beeline
