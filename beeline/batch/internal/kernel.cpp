#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include <beeline/batch/internal/kernel.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/batch/internal/kernel.cpp"
#include <hwy/foreach_target.h>

#include <beeline/batch/internal/frames-inl.h>
#include <beeline/batch/internal/line_writer-inl.h>
#include <beeline/batch/internal/transpose-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using internal::BatchJob;

/// Sets the results of configurations with a coordinate that is not finite to NaN.
template <class Real>
HWY_NOINLINE void set_nan(const BatchPlan<Real>& plan, const Real* q, int count, Real* rows) {
  constexpr int width = Packet<Real>::width;
  for (int lane = 0; lane < width; ++lane) {
    Real nan_or_zero = 0;
    for (int k = 0; k < plan.dof; ++k) nan_or_zero += 0 * q[k * width + lane];
    for (int i = 0; nan_or_zero != 0 && i < count; ++i) rows[i * width + lane] = nan_or_zero;
  }
}

/// The buffers for the intermediate results of one packet of configurations.
template <class Real>
struct Rows {
  Real *q, *sines, *cosines, *axes, *results, *columns, *poses;

  explicit HWY_INLINE Rows(const BatchJob<Real>& job) {
    constexpr int width = Packet<Real>::width;
    const int links = static_cast<int>(job.plan->links.size());
    q = job.work;
    sines = q + job.plan->dof * width;
    cosines = sines + links * width;
    axes = cosines + links * width;
    results = axes + 6 * links * width;
    columns = results + std::max(16, 6 * job.plan->dof) * width;
    poses = columns + 2 * (6 * job.plan->dof * width + batch_width);
  }
};

template <class Real>
HWY_INLINE void write(const BatchJob<Real>& job, bool near, const Rows<Real>& rows, int count,
                      Real* to, Eigen::Index stride) {
  if (HWY_UNLIKELY(!near)) set_nan(*job.plan, rows.q, count, rows.results);
  store_rows(rows.results, count, to, stride);
}

/// Stores the origin and the direction of a link's axis as six rows; `vertical` axes are exactly
/// +-z.
template <class Real>
HWY_INLINE void store_axis(const PacketFrame<Real>& frame, bool vertical, Real* rows) {
  frame.origin.store(rows);
  PacketVector<Real> direction = frame.z;
  if (vertical) direction = {round(direction.x), round(direction.y), round(direction.z)};
  direction.store(rows + 3 * Packet<Real>::width);
}

enum class Wanted { tool, columns, links };

template <Wanted wanted, class Real, bool buffered>
HWY_INLINE void run_packet(const BatchJob<Real>& job, const Rows<Real>& rows, Eigen::Index first,
                           LineWriter<Real, buffered>& columns, LineWriter<Real, buffered>& poses) {
  constexpr int width = Packet<Real>::width;
  const BatchPlan<Real>& plan = *job.plan;
  const int dof = plan.dof, links = static_cast<int>(plan.links.size());
  const int pose_size = job.layout == PoseLayout::matrix ? 16 : 7;
  const auto write_some = [&]() HWY_ATTR {
    columns.write_some();
    poses.write_some();
  };
  load_rows(job.q + first * dof, dof, rows.q);
  const bool near = store_sines(plan, rows.q, rows.sines, rows.cosines, write_some);
  if (HWY_UNLIKELY(!near)) store_far_sines(plan, rows.q, rows.sines, rows.cosines);

  const Eigen::Index link_stride = Eigen::Index(links + 1) * pose_size;
  if constexpr (wanted == Wanted::links) {
    write_pose(PacketFrame<Real>::broadcast_from(plan.base_link.number), job.layout, rows.results);
    write(job, near, rows, pose_size, poses.next(), link_stride);
  }
  auto frame = PacketFrame<Real>::broadcast_from(plan.base.number);
  Real* axes = rows.axes;
  for (int i = 0; i < links; ++i) {
    write_some();
    multiply(frame, plan.links[i], rows.q, rows.sines + i * width, rows.cosines + i * width);
    if constexpr (wanted == Wanted::columns) {
      store_axis(frame, plan.planar && plan.links[i].rotates, axes);
      axes += 6 * width;
    }
    if constexpr (wanted == Wanted::links) {
      write_pose(times<Real>(frame, plan.frame_T_link[i]), job.layout, rows.results);
      write(job, near, rows, pose_size, poses.next() + (i + 1) * pose_size, link_stride);
    }
  }
  if constexpr (wanted == Wanted::links) return poses.push();
  multiply_by_tool(frame, plan);
  if constexpr (wanted == Wanted::columns) {
    if (near && plan.in_order && !job.manipulability) {
      store_columns(plan, job.frame, frame, rows.axes, columns.next());
    } else {
      write_columns(plan, job.frame, frame, rows.axes, rows.results);
      if (job.columns) {
        write(job, near, rows, 6 * dof, columns.next(), Eigen::Index(6) * dof);
      }
    }
    if (job.columns) columns.push();
    if (job.manipulability) {
      volume(dof, plan.planar, rows.results).store(rows.results);
      write(job, near, rows, 1, job.manipulability + first, 1);
    }
  }
  if (job.world_T_tool && near && job.layout == PoseLayout::matrix) {
    store_matrix(frame, poses.next(), pose_size);
  } else if (job.world_T_tool) {
    write_pose(frame, job.layout, rows.results);
    write(job, near, rows, pose_size, poses.next(), pose_size);
  }
  if (job.world_T_tool) poses.push();
}

template <Wanted wanted, bool buffered, class Real>
HWY_NOINLINE void run_all(const BatchJob<Real>& job) {
  const Rows<Real> rows(job);
  constexpr bool every_link = wanted == Wanted::links;
  const auto links = static_cast<Eigen::Index>(job.plan->links.size());
  LineWriter<Real, buffered> columns(job.columns, 6 * job.plan->dof, rows.columns, links);
  LineWriter<Real, buffered> poses(every_link ? job.world_T_link : job.world_T_tool,
                                   size(job.layout) * (every_link ? links + 1 : 1), rows.poses,
                                   links);
  for (Eigen::Index i = 0; i < job.count; i += Packet<Real>::width) {
    run_packet<wanted>(job, rows, i, columns, poses);
  }
  columns.finish();
  poses.finish();
}

template <bool buffered, class Real>
HWY_INLINE void run(const BatchJob<Real>& job) {
  if (job.world_T_link) {
    run_all<Wanted::links, buffered>(job);
  } else if (job.columns || job.manipulability) {
    run_all<Wanted::columns, buffered>(job);
  } else {
    run_all<Wanted::tool, buffered>(job);
  }
}

template <class Real>
HWY_INLINE void run(const BatchJob<Real>& job) {
#if HWY_TARGET != HWY_SCALAR  // with HWY_SCALAR arithmetic takes longer than writing
  if (job.past_caches) return run<true>(job);
#endif
  run<false>(job);
}

void run_double(const BatchJob<double>& job) { run(job); }
void run_float(const BatchJob<float>& job) { run(job); }

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {
HWY_EXPORT(run_double);
HWY_EXPORT(run_float);
}  // namespace beeline

namespace beeline::internal {

template <>
void batch_kernel(const BatchJob<double>& job) {
  HWY_DYNAMIC_DISPATCH(run_double)(job);
}
template <>
void batch_kernel(const BatchJob<float>& job) {
  HWY_DYNAMIC_DISPATCH(run_float)(job);
}

template <class Real>
Eigen::Index batch_work_size(const BatchPlan<Real>& plan) {
  const auto links = static_cast<Eigen::Index>(plan.links.size());
  // Rows: coordinates, sines, cosines, axes, results. Then two line buffers for each kind of
  // result.
  const Eigen::Index columns = 6 * plan.dof, poses = 16 * (links + 1);
  return batch_width *
         (plan.dof + 8 * links + std::max<Eigen::Index>(16, columns) + 2 * (columns + poses + 2));
}
template Eigen::Index batch_work_size(const BatchPlan<double>&);
template Eigen::Index batch_work_size(const BatchPlan<float>&);

}  // namespace beeline::internal
#endif
