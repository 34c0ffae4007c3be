#pragma once

#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline {

/// The layout of a pose in a column.
enum class PoseLayout {
  matrix,               ///< 16 values: the 4 x 4 matrix, column by column
  position_quaternion,  ///< 7 values: x y z qw qx qy qz, with qw >= 0
};
/// The number of values of a pose: 16 or 7.
int size(PoseLayout layout);

struct BatchOptions {
  PoseLayout layout = PoseLayout::matrix;
  Frame frame = Frame::base;  ///< frame of the Jacobians
  int threads = 0;  ///< number of threads; 0: one for each core. The results do not depend on it.
  /// Budget of the whole batch. A unit of its work is one column. The columns that are computed
  /// before it ends depend on the threads. Any of the threads reports the fraction computed.
  Budget budget = {};
};

/// Counts of a batch. The columns that it did not compute, because its budget ended, are NaN.
struct BatchResult {
  Ending ending = Ending::complete;
  Eigen::Index computed = 0;  ///< number of columns computed
  Eigen::Index solved = 0;    ///< number of columns with a solution, for batch_inverse()
};

// Kinematics of N configurations, one in each column of q: dof x N, rad and m. A row-major numpy
// array of shape (N, dof) has the same memory layout. Real is float or double; with float all
// arithmetic is in float. The results are written into the caller's matrices of N columns. If a
// value in a column of q is not finite, the results of this column are not finite either. The work
// is divided among threads. All functions throw Error when the size of a matrix does not fit.

// The stride is written out, as the compilers name Eigen's default of it differently: Clang would
// not find these functions in a library of GCC's.
template <class Real>
using ColumnsRef =
    Eigen::Ref<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;
template <class Real>
using ConstColumnsRef =
    Eigen::Ref<const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;

/// Computes the poses of the tool, size(layout) x N.
template <class Real>
BatchResult batch_forward(const Arm& arm, const ConstColumnsRef<Real>& q,
                          ColumnsRef<Real> world_T_tool, const BatchOptions& options = {});

/// Computes the poses of links 0 to n, stacked in each column: (n + 1) size(layout) x N.
template <class Real>
BatchResult batch_link_poses(const Arm& arm, const ConstColumnsRef<Real>& q,
                             ColumnsRef<Real> world_T_link, const BatchOptions& options = {});

/// Computes the Jacobians, column by column, 6 dof x N. Also computes the poses of the tool, unless
/// `world_T_tool` has no columns.
template <class Real>
BatchResult batch_jacobian(const Arm& arm, const ConstColumnsRef<Real>& q,
                           ColumnsRef<Real> jacobians, ColumnsRef<Real> world_T_tool,
                           const BatchOptions& options = {});

/// Computes the manipulability sqrt(det(J J^T)), 1 x N, as manipulability_measures() does. J has
/// the rows of default_task(): x, y and theta for a planar arm, otherwise all six.
template <class Real>
BatchResult batch_manipulability(const Arm& arm, const ConstColumnsRef<Real>& q,
                                 ColumnsRef<Real> values, const BatchOptions& options = {});

/// Computes one solution for each pose, as inverse_kinematics() does: `world_T_tool` is
/// size(layout) x N, `q` dof x N, `seeds` dof x N, or dof x 1 for all poses. If no solution is
/// found, the column of q is NaN, also for a pose with a value that is not finite. The default of
/// `inverse.redundancy` is the default with a seed, the nearest solution found from it.
/// `inverse.budget` is the budget of each pose. Throws Error for `inverse.all`, and, naming the
/// pose by its number from 1 on, before anything is computed, for a pose that inverse_kinematics()
/// refuses: one that is not a rigid motion, or outside the plane of a planar arm.
BatchResult batch_inverse(const Arm& arm, const ConstColumnsRef<double>& world_T_tool,
                          const ConstColumnsRef<double>& seeds, ColumnsRef<double> q,
                          const InverseOptions& inverse = {}, const BatchOptions& options = {});

/// The status and the residual of an InverseResult.
struct InverseOutcome {
  InverseStatus status = InverseStatus::not_found;
  double residual = 0;  ///< residual in metres or radians, see InverseResult
};

/// Does the same, and returns the outcome of each pose. A pose that the batch did not compute has
/// the status of its budget and a residual of NaN. A pose without a solution takes longer, because
/// the residual needs explain().
BatchResult batch_inverse(const Arm& arm, const ConstColumnsRef<double>& world_T_tool,
                          const ConstColumnsRef<double>& seeds, ColumnsRef<double> q,
                          std::vector<InverseOutcome>& outcomes, const InverseOptions& inverse = {},
                          const BatchOptions& options = {});

}  // namespace beeline
