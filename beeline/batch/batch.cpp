#include <algorithm>
#include <array>

#include <beeline/batch/parallel.h>
#include <beeline/batch/plan.h>
#include <beeline/batch/shape.h>

#include <hwy/aligned_allocator.h>

namespace beeline {
namespace {

/// Configurations that one thread takes at a time; and those that go through buffers together.
constexpr Eigen::Index block = 1024, chunk = batch_width;
/// Results of more bytes leave the nearest cache; and all caches.
constexpr double max_near = 24e3, max_cached = 16e6;

/// One kind of result: the caller's matrix, and where the job has its pointer to it.
template <class Real>
struct Sheet {
  Real* BatchJob<Real>::*place;
  ColumnsRef<Real>* matrix;

  Eigen::Index rows() const { return matrix->rows(); }
};

template <class Real>
using Sheets = std::vector<Sheet<Real>>;

/// Numbers at a multiple of 64 bytes.
template <class Real>
using Buffer = hwy::AlignedFreeUniquePtr<Real[]>;
template <class Real>
Buffer<Real> allocated(Eigen::Index numbers) {
  return hwy::AllocateAligned<Real>(static_cast<size_t>(numbers));
}

/// The columns from `first` to `last` by the kernel: side by side, a multiple of batch_width.
template <class Real>
void compute(BatchJob<Real>& job, const ConstColumnsRef<Real>& q, const Sheets<Real>& sheets,
             Eigen::Index first, Eigen::Index last) {
  job.q = q.data() + first * q.rows();
  job.count = last - first;
  for (const Sheet<Real>& sheet : sheets) {
    job.*sheet.place = sheet.matrix->data() + first * sheet.rows();
  }
  batch_kernel(job);
}

/// Through buffers where they are too few, or not side by side.
template <class Real>
void compute_apart(BatchJob<Real>& job, const ConstColumnsRef<Real>& q, const Sheets<Real>& sheets,
                   Eigen::Index first, Eigen::Index last) {
  Eigen::Index room = q.rows();
  for (const Sheet<Real>& sheet : sheets) room += sheet.rows();
  const Buffer<Real> buffer = allocated<Real>(chunk * room);
  job.write = BatchWrite::at_once;
  job.count = chunk;
  job.q = buffer.get();
  for (; first < last; first += chunk) {
    const Eigen::Index count = std::min(chunk, last - first);
    Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>> padded(buffer.get(), q.rows(),
                                                                           chunk);
    padded.leftCols(count) = q.middleCols(first, count);
    padded.rightCols(chunk - count).setZero();
    Real* free = buffer.get() + chunk * q.rows();
    for (const Sheet<Real>& sheet : sheets) {
      job.*sheet.place = free;
      free += chunk * sheet.rows();
    }
    batch_kernel(job);
    for (const Sheet<Real>& sheet : sheets) {
      sheet.matrix->middleCols(first, count) =
          Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>(job.*sheet.place,
                                                                          sheet.rows(), count);
    }
  }
}

template <class Real>
void run(const Arm& arm, const ConstColumnsRef<Real>& q, const Sheets<Real>& sheets,
         const BatchOptions& options) {
  check_rows(arm, "q", q, arm.dof());
  double bytes = 0;
  bool side_by_side = q.outerStride() == q.rows();
  for (const Sheet<Real>& sheet : sheets) {
    bytes += static_cast<double>(sheet.rows()) * static_cast<double>(q.cols()) * sizeof(Real);
    side_by_side = side_by_side && sheet.matrix->outerStride() == sheet.rows();
  }
  const BatchPlan<Real> plan(arm);
  BatchJob<Real> all{};
  all.plan = &plan;
  all.layout = options.layout;
  all.frame = options.frame;
  all.write = bytes > max_cached ? BatchWrite::past_caches
              : bytes > max_near ? BatchWrite::by_lines
                                 : BatchWrite::at_once;
  in_parallel(q.cols(), block, options.threads, [&](Eigen::Index first, Eigen::Index last) {
    BatchJob<Real> job = all;
    const Buffer<Real> work = allocated<Real>(batch_work(plan));
    job.work = work.get();
    const Eigen::Index whole =
        side_by_side ? first + (last - first) / batch_width * batch_width : first;
    if (whole != first) compute(job, q, sheets, first, whole);
    if (whole != last) compute_apart(job, q, sheets, whole, last);
  });
}

}  // namespace

int size(PoseLayout layout) { return layout == PoseLayout::matrix ? 16 : 7; }

template <class Real>
void batch_forward(const Arm& arm, ConstColumnsRef<Real> q, ColumnsRef<Real> world_T_tool,
                   const BatchOptions& options) {
  check_shape(arm, "world_T_tool", world_T_tool, size(options.layout), q.cols());
  run<Real>(arm, q, {{&BatchJob<Real>::world_T_tool, &world_T_tool}}, options);
}

template <class Real>
void batch_link_poses(const Arm& arm, ConstColumnsRef<Real> q, ColumnsRef<Real> world_T_link,
                      const BatchOptions& options) {
  const Eigen::Index poses = static_cast<Eigen::Index>(arm.joints().size()) + 1;
  check_shape(arm, "world_T_link", world_T_link, poses * size(options.layout), q.cols());
  run<Real>(arm, q, {{&BatchJob<Real>::world_T_link, &world_T_link}}, options);
}

template <class Real>
void batch_jacobian(const Arm& arm, ConstColumnsRef<Real> q, ColumnsRef<Real> jacobians,
                    ColumnsRef<Real> world_T_tool, const BatchOptions& options) {
  check_shape(arm, "jacobians", jacobians, 6 * arm.dof(), q.cols());
  Sheets<Real> sheets{{&BatchJob<Real>::columns, &jacobians}};
  if (world_T_tool.cols() != 0) {
    check_shape(arm, "world_T_tool", world_T_tool, size(options.layout), q.cols());
    sheets.push_back({&BatchJob<Real>::world_T_tool, &world_T_tool});
  }
  run<Real>(arm, q, sheets, options);
}

template <class Real>
void batch_manipulability(const Arm& arm, ConstColumnsRef<Real> q, ColumnsRef<Real> values,
                          const BatchOptions& options) {
  check_shape(arm, "values", values, 1, q.cols());
  BatchOptions in_base = options;
  in_base.frame = Frame::base;  // in which planar arms' directions are exact
  run<Real>(arm, q, {{&BatchJob<Real>::manipulability, &values}}, in_base);
}

#define BEELINE_BATCH(REAL)                                                                     \
  template void batch_forward<REAL>(const Arm&, ConstColumnsRef<REAL>, ColumnsRef<REAL>,        \
                                    const BatchOptions&);                                       \
  template void batch_link_poses<REAL>(const Arm&, ConstColumnsRef<REAL>, ColumnsRef<REAL>,     \
                                       const BatchOptions&);                                    \
  template void batch_jacobian<REAL>(const Arm&, ConstColumnsRef<REAL>, ColumnsRef<REAL>,       \
                                     ColumnsRef<REAL>, const BatchOptions&);                    \
  template void batch_manipulability<REAL>(const Arm&, ConstColumnsRef<REAL>, ColumnsRef<REAL>, \
                                           const BatchOptions&);
BEELINE_BATCH(double)
BEELINE_BATCH(float)
#undef BEELINE_BATCH

}  // namespace beeline
