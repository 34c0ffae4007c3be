#pragma once

#include <beeline/batch/batch.h>
#include <beeline/batch/internal/plan.h>

namespace beeline::internal {

/// The number of configurations of a job is a multiple of this.
inline constexpr Eigen::Index batch_width = 16;

/// The results wanted for `count` contiguous configurations. A null pointer means not wanted.
template <class Real>
struct BatchJob {
  const BatchPlan<Real>* plan;
  PoseLayout layout;
  Frame frame;
  const Real* q;         ///< coordinates, dof numbers for each configuration
  Eigen::Index count;    ///< a multiple of batch_width
  Real* world_T_tool;    ///< tool poses, size(layout) numbers each
  Real* world_T_link;    ///< link poses, (links + 1) size(layout) numbers each
  Real* columns;         ///< Jacobian columns, 6 dof numbers each
  Real* manipulability;  ///< manipulability, one number each
  bool past_caches;  ///< whether large results are written by non-temporal stores of whole cache
                     ///< lines
  Real* work;        ///< buffer of batch_work_size() numbers, aligned to 64 bytes
};

/// The size of a job's work buffer.
template <class Real>
Eigen::Index batch_work_size(const BatchPlan<Real>& plan);

/// Computes the job's results.
template <class Real>
void batch_kernel(const BatchJob<Real>& job);

}  // namespace beeline::internal
