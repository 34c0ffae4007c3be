#include <algorithm>
#include <array>

#include <beeline/batch/parallel.h>
#include <beeline/batch/plan.h>
#include <beeline/batch/shape.h>

#include <hwy/aligned_allocator.h>

namespace beeline {
namespace {

/// As many configurations as fit into the nearest cache with their results; and as many as one
/// thread takes at a time.
constexpr Eigen::Index chunk = 32, block = 1024;
/// Results of more bytes than that are written past the caches.
constexpr double cached = 16e6;

/// One kind of result: the caller's matrix, and where the job has its pointer to it.
template <class Real>
struct Sheet {
  Real* BatchJob<Real>::*place;
  ColumnsRef<Real>* matrix;

  Eigen::Index rows() const { return matrix->rows(); }
  bool side_by_side() const { return matrix->outerStride() == rows(); }
};

template <class Real>
using Sheets = std::vector<Sheet<Real>>;

/// Numbers at a multiple of 64 bytes.
template <class Real>
using Buffer = hwy::AlignedFreeUniquePtr<Real[]>;
template <class Real>
Buffer<Real> buffer(Eigen::Index numbers) {
  return hwy::AllocateAligned<Real>(static_cast<size_t>(numbers));
}

Eigen::Index rounded_up(Eigen::Index count) {
  return (count + batch_width - 1) / batch_width * batch_width;
}

/// The columns from `first` to `last`: through small buffers where they are the last ones, which
/// are too few, or are not side by side; or too many for the caches.
template <class Real>
void compute(BatchJob<Real> job, const ConstColumnsRef<Real>& q, const Sheets<Real>& sheets,
             bool past_caches, Eigen::Index first, Eigen::Index last) {
  Eigen::Index room = 0;
  for (const Sheet<Real>& sheet : sheets) room += rounded_up(sheet.rows());
  const Buffer<Real> work = buffer<Real>(batch_work(*job.plan));
  const Buffer<Real> columns = buffer<Real>(chunk * q.rows());
  const Buffer<Real> results = buffer<Real>(chunk * room);
  job.work = work.get();
  for (; first < last; first += chunk) {
    const Eigen::Index count = std::min(chunk, last - first);
    job.count = rounded_up(count);
    const bool whole = job.count == count;
    job.q = q.data() + first * q.outerStride();
    if (!whole || q.outerStride() != q.rows()) {
      Eigen::Map<Eigen::Matrix<Real, -1, -1>> padded(columns.get(), q.rows(), job.count);
      padded.leftCols(count) = q.middleCols(first, count);
      padded.rightCols(job.count - count).setZero();
      job.q = columns.get();
    }
    Real* free = results.get();
    for (const Sheet<Real>& sheet : sheets) {
      const bool direct = whole && sheet.side_by_side() && !past_caches;
      job.*sheet.place = direct ? sheet.matrix->data() + first * sheet.rows() : free;
      free += chunk * rounded_up(sheet.rows());
    }
    batch_kernel(job);
    for (const Sheet<Real>& sheet : sheets) {
      const Real* made = job.*sheet.place;
      Real* to = sheet.matrix->data() + first * sheet.matrix->outerStride();
      if (made == to) continue;
      if (past_caches && sheet.side_by_side()) {
        batch_copy(made, count * sheet.rows(), to);
        continue;
      }
      for (Eigen::Index i = 0; i < count; ++i) {
        std::copy_n(made + i * sheet.rows(), sheet.rows(), to + i * sheet.matrix->outerStride());
      }
    }
  }
  if (past_caches) batch_copied();
}

template <class Real>
void run(const Arm& arm, const ConstColumnsRef<Real>& q, const Sheets<Real>& sheets,
         const BatchOptions& options) {
  check_rows(arm, "q", q, arm.dof());
  double numbers = 0;
  for (const Sheet<Real>& sheet : sheets) {
    numbers += static_cast<double>(sheet.rows()) * static_cast<double>(q.cols());
  }
  const bool past_caches = numbers * sizeof(Real) > cached;
  const BatchPlan<Real> plan(arm);
  BatchJob<Real> job{};
  job.plan = &plan;
  job.layout = options.layout;
  job.frame = options.frame;
  in_parallel(q.cols(), block, options.threads, [&](Eigen::Index first, Eigen::Index last) {
    compute(job, q, sheets, past_caches, first, last);
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
