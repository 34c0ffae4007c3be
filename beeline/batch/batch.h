#pragma once

#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline {

/// The layout of a pose in a column.
enum class PoseLayout {
  matrix,               ///< 16: the 4 x 4 matrix, column by column
  position_quaternion,  ///< 7: x y z qw qx qy qz, qw >= 0
};
/// The number of values of a pose: 16 or 7.
int size(PoseLayout layout);

struct BatchOptions {
  PoseLayout layout = PoseLayout::matrix;
  Frame frame = Frame::base;  ///< of Jacobians
  int threads = 0;            ///< 0: one for each core. The results do not depend on it.
  /// Of the whole batch. A unit of its work is one column. Which columns are computed before it
  /// ends depends on the threads. Reports the fraction computed, from any of them.
  Budget budget = {};
};

/// What a batch has computed. Columns that it did not come to, as its budget ended, are NaN.
struct BatchResult {
  Ending ending = Ending::complete;
  Eigen::Index computed = 0;  ///< columns
  Eigen::Index solved = 0;    ///< those with a solution, of batch_inverse()
};

// Kinematics of N configurations, one in each column of q: dof x N, rad and m. A row-major numpy
// array of shape (N, dof) has the same memory layout. Real is float or double; with float all
// arithmetic is in float. The results are written into the caller's matrices of N columns; where a
// value in a column of q is not finite, neither are its results. The work is divided among threads.
// All functions throw Error when the size of a matrix does not fit.

template <class Real>
using ColumnsRef = Eigen::Ref<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>;
template <class Real>
using ConstColumnsRef = Eigen::Ref<const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>;

/// Computes the poses of the tool, size(layout) x N.
template <class Real>
BatchResult batch_forward(const Arm& arm, const ConstColumnsRef<Real>& q,
                          ColumnsRef<Real> world_T_tool, const BatchOptions& options = {});

/// Computes the poses of links 0 to n, one below the other: (n + 1) size(layout) x N.
template <class Real>
BatchResult batch_link_poses(const Arm& arm, const ConstColumnsRef<Real>& q,
                             ColumnsRef<Real> world_T_link, const BatchOptions& options = {});

/// Computes the Jacobians, column by column, 6 dof x N; and the poses of the tool, unless
/// `world_T_tool` has no columns.
template <class Real>
BatchResult batch_jacobian(const Arm& arm, const ConstColumnsRef<Real>& q,
                           ColumnsRef<Real> jacobians, ColumnsRef<Real> world_T_tool,
                           const BatchOptions& options = {});

/// Computes the manipulability sqrt(det(J J^T)) of the rows of the Jacobian that default_task()
/// has, x, y and theta of a planar arm and all six of another, as manipulability_measures() does: 1
/// x N.
template <class Real>
BatchResult batch_manipulability(const Arm& arm, const ConstColumnsRef<Real>& q,
                                 ColumnsRef<Real> values, const BatchOptions& options = {});

/// Computes one solution for each pose: `world_T_tool` is size(layout) x N, `q` dof x N, `seeds`
/// dof x N, or dof x 1 for all. Where no solution is found the column of q is NaN. `inverse.all`
/// and `inverse.every_turn` are ignored; `inverse.budget` is that of each pose. The solutions are
/// those of inverse_kinematics().
BatchResult batch_inverse(const Arm& arm, const ConstColumnsRef<double>& world_T_tool,
                          const ConstColumnsRef<double>& seeds, ColumnsRef<double> q,
                          const InverseOptions& inverse = {}, const BatchOptions& options = {});

/// The status and the residual of an InverseResult.
struct InverseOutcome {
  InverseStatus status = InverseStatus::not_found;
  double residual = 0;  ///< metres or radians, see InverseResult
};

/// The same, with the outcome of each pose; those that the batch did not come to have the status of
/// its budget and a residual of NaN. A pose without a solution takes longer, as
/// inverse_kinematics() finds out why.
BatchResult batch_inverse(const Arm& arm, const ConstColumnsRef<double>& world_T_tool,
                          const ConstColumnsRef<double>& seeds, ColumnsRef<double> q,
                          std::vector<InverseOutcome>& outcomes, const InverseOptions& inverse = {},
                          const BatchOptions& options = {});

}  // namespace beeline
