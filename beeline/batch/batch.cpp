#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <vector>

#include <beeline/batch/batch.h>
#include <beeline/batch/internal/kernel.h>
#include <beeline/batch/internal/parallel.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/internal/tool_plane.h>
#include <beeline/pose/se3.h>

#include <hwy/aligned_allocator.h>

namespace beeline {
namespace {

using internal::batch_kernel;
using internal::batch_width;
using internal::BatchJob;
using internal::BatchPlan;
using internal::in_parallel;

constexpr Eigen::Index block = 1024;         // configurations that a thread takes at a time
constexpr Eigen::Index chunk = batch_width;  // configurations copied through a buffer at a time
constexpr double cached_bytes = 16e6;  // bytes that stay in a last-level cache of a common machine

template <class Matrix>
void check_rows(const Arm& arm, const std::string& name, const Matrix& matrix, Eigen::Index rows) {
  if (matrix.rows() == rows) return;
  throw Error(name + " has " + std::to_string(matrix.rows()) + " rows; arm " + arm.name() +
              " needs " + std::to_string(rows));
}

template <class Matrix>
void check_shape(const Arm& arm, const std::string& name, const Matrix& matrix, Eigen::Index rows,
                 Eigen::Index columns) {
  check_rows(arm, name, matrix, rows);
  if (matrix.cols() == columns) return;
  throw Error(name + " has " + std::to_string(matrix.cols()) + " columns, not " +
              std::to_string(columns) + ", one for each configuration");
}

/// One kind of result: the caller's matrix, and the job's pointer to it.
template <class Real>
struct Output {
  Real* BatchJob<Real>::*member;
  ColumnsRef<Real>* matrix;

  Eigen::Index rows() const { return matrix->rows(); }
};

template <class Real>
using Outputs = std::vector<Output<Real>>;

/// Memory at a multiple of 64 bytes.
template <class Real>
using Buffer = hwy::AlignedFreeUniquePtr<Real[]>;
template <class Real>
Buffer<Real> allocated(Eigen::Index numbers) {
  return hwy::AllocateAligned<Real>(static_cast<size_t>(numbers));
}

/// Computes the columns from `first` to `last`, contiguous and a multiple of batch_width.
template <class Real>
void compute(BatchJob<Real>& job, const ConstColumnsRef<Real>& q, const Outputs<Real>& outputs,
             Eigen::Index first, Eigen::Index last) {
  job.q = q.data() + first * q.rows();
  job.count = last - first;
  for (const Output<Real>& output : outputs) {
    job.*output.member = output.matrix->data() + first * output.rows();
  }
  batch_kernel(job);
}

/// Computes the columns from `first` to `last` through a buffer, if they are fewer or not
/// contiguous.
template <class Real>
void compute_buffered(BatchJob<Real>& job, const ConstColumnsRef<Real>& q,
                      const Outputs<Real>& outputs, Eigen::Index first, Eigen::Index last) {
  Eigen::Index numbers = q.rows();
  for (const Output<Real>& output : outputs) numbers += output.rows();
  const Buffer<Real> buffer = allocated<Real>(chunk * numbers);
  job.past_caches = false;
  job.count = chunk;
  job.q = buffer.get();
  for (; first < last; first += chunk) {
    const Eigen::Index count = std::min(chunk, last - first);
    Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>> padded(buffer.get(), q.rows(),
                                                                           chunk);
    padded.leftCols(count) = q.middleCols(first, count);
    padded.rightCols(chunk - count).setZero();
    Real* free = buffer.get() + chunk * q.rows();
    for (const Output<Real>& output : outputs) {
      job.*output.member = free;
      free += chunk * output.rows();
    }
    batch_kernel(job);
    for (const Output<Real>& output : outputs) {
      output.matrix->middleCols(first, count) =
          Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>(job.*output.member,
                                                                          output.rows(), count);
    }
  }
}

/// The state of a batch that any of its threads may end.
class Counts {
 public:
  Counts(const Budget& budget, Eigen::Index all) : budget_(budget), computed_(budget_, all) {}

  internal::BudgetMeter& budget() { return budget_; }
  void add(Eigen::Index computed, Eigen::Index solved) {
    solved_ += solved;
    computed_.add(computed);
  }
  BatchResult result() {
    if (budget_.complete()) budget_.report(1);
    return {budget_.ending(), static_cast<Eigen::Index>(computed_.count()), solved_};
  }

 private:
  internal::BudgetMeter budget_;
  internal::FinishedSteps computed_;
  std::atomic<Eigen::Index> solved_ = 0;
};

template <class Real>
BatchResult run(const Arm& arm, const ConstColumnsRef<Real>& q, const Outputs<Real>& outputs,
                const BatchOptions& options) {
  constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();
  check_rows(arm, "q", q, arm.dof());
  double bytes = 0;
  bool contiguous = q.outerStride() == q.rows();
  for (const Output<Real>& output : outputs) {
    bytes += static_cast<double>(output.rows()) * static_cast<double>(q.cols()) * sizeof(Real);
    contiguous = contiguous && output.matrix->outerStride() == output.rows();
  }
  const BatchPlan<Real> plan(arm);
  BatchJob<Real> all{};
  all.plan = &plan;
  all.layout = options.layout;
  all.frame = options.frame;
  all.past_caches = bytes > cached_bytes;
  Counts counts(options.budget, q.cols());
  in_parallel(q.cols(), block, options.threads, [&](Eigen::Index first, Eigen::Index last) {
    if (counts.budget().ended(last - first)) {
      for (const Output<Real>& output : outputs) {
        output.matrix->middleCols(first, last - first).setConstant(unknown);
      }
      return;
    }
    counts.add(last - first, 0);
    BatchJob<Real> job = all;
    const Buffer<Real> work = allocated<Real>(batch_work_size(plan));
    job.work = work.get();
    const Eigen::Index whole =
        contiguous ? first + (last - first) / batch_width * batch_width : first;
    if (whole != first) compute(job, q, outputs, first, whole);
    if (whole != last) compute_buffered(job, q, outputs, whole, last);
  });
  return counts.result();
}

Pose pose_in_layout(const double* number, PoseLayout layout) {
  if (layout == PoseLayout::matrix) {
    Pose pose;
    pose.matrix() = Eigen::Map<const Eigen::Matrix4d>(number);
    return pose;
  }
  return make_pose({number[0], number[1], number[2]},
                   rotation_from_quaternion(number[3], number[4], number[5], number[6]));
}

}  // namespace

int size(PoseLayout layout) { return layout == PoseLayout::matrix ? 16 : 7; }

template <class Real>
BatchResult batch_forward(const Arm& arm, const ConstColumnsRef<Real>& q,
                          ColumnsRef<Real> world_T_tool, const BatchOptions& options) {
  check_shape(arm, "world_T_tool", world_T_tool, size(options.layout), q.cols());
  return run<Real>(arm, q, {{&BatchJob<Real>::world_T_tool, &world_T_tool}}, options);
}

template <class Real>
BatchResult batch_link_poses(const Arm& arm, const ConstColumnsRef<Real>& q,
                             ColumnsRef<Real> world_T_link, const BatchOptions& options) {
  const Eigen::Index poses = static_cast<Eigen::Index>(arm.joints().size()) + 1;
  check_shape(arm, "world_T_link", world_T_link, poses * size(options.layout), q.cols());
  return run<Real>(arm, q, {{&BatchJob<Real>::world_T_link, &world_T_link}}, options);
}

template <class Real>
BatchResult batch_jacobian(const Arm& arm, const ConstColumnsRef<Real>& q,
                           ColumnsRef<Real> jacobians, ColumnsRef<Real> world_T_tool,
                           const BatchOptions& options) {
  check_shape(arm, "jacobians", jacobians, 6 * arm.dof(), q.cols());
  Outputs<Real> outputs{{&BatchJob<Real>::columns, &jacobians}};
  if (world_T_tool.cols() != 0) {
    check_shape(arm, "world_T_tool", world_T_tool, size(options.layout), q.cols());
    outputs.push_back({&BatchJob<Real>::world_T_tool, &world_T_tool});
  }
  return run<Real>(arm, q, outputs, options);
}

template <class Real>
BatchResult batch_manipulability(const Arm& arm, const ConstColumnsRef<Real>& q,
                                 ColumnsRef<Real> values, const BatchOptions& options) {
  check_shape(arm, "values", values, 1, q.cols());
  BatchOptions in_base = options;
  in_base.frame = Frame::base;  // in this frame the axes of planar arms are exact
  return run<Real>(arm, q, {{&BatchJob<Real>::manipulability, &values}}, in_base);
}

#define BEELINE_BATCH(REAL)                                                                 \
  template BatchResult batch_forward<REAL>(const Arm&, const ConstColumnsRef<REAL>&,        \
                                           ColumnsRef<REAL>, const BatchOptions&);          \
  template BatchResult batch_link_poses<REAL>(const Arm&, const ConstColumnsRef<REAL>&,     \
                                              ColumnsRef<REAL>, const BatchOptions&);       \
  template BatchResult batch_jacobian<REAL>(const Arm&, const ConstColumnsRef<REAL>&,       \
                                            ColumnsRef<REAL>, ColumnsRef<REAL>,             \
                                            const BatchOptions&);                           \
  template BatchResult batch_manipulability<REAL>(const Arm&, const ConstColumnsRef<REAL>&, \
                                                  ColumnsRef<REAL>, const BatchOptions&);
BEELINE_BATCH(double)
BEELINE_BATCH(float)
#undef BEELINE_BATCH

namespace {

/// Computes a solution of one pose, with options.seed replaced, into a column, which becomes NaN if
/// there is none. Returns whether there is one.
bool solve_column(const Arm& arm, const Pose& world_T_tool, const ConfigurationRef& seed,
                  InverseOptions& options, Eigen::Ref<Eigen::MatrixXd> q, InverseOutcome* outcome) {
  if (outcome == nullptr) return inverse_kinematics(arm, world_T_tool, seed, q, options) != 0;
  options.seed = seed;
  InverseResult result = inverse_kinematics(arm, world_T_tool, options);
  explain(result, options.budget);
  *outcome = {result.status, result.residual};
  if (result) q = result.solutions.front();
  return result.status == InverseStatus::solved;
}

/// Throws Error, which names the first such column, for a pose that inverse_kinematics() refuses:
/// as in a single call these are errors of the argument, found before anything is computed. A
/// column with a value that is not finite has no solution.
void check_poses(const Arm& arm, const ConstColumnsRef<double>& world_T_tool,
                 const std::optional<Task>& task, PoseLayout layout) {
  const auto plane = internal::ToolPlane::required(arm, task);
  for (Eigen::Index i = 0; i < world_T_tool.cols(); ++i) {
    if (!world_T_tool.col(i).allFinite()) continue;
    try {
      const Pose pose =
          pose_in_layout(world_T_tool.data() + i * world_T_tool.outerStride(), layout);
      if (plane) plane->check(pose);
      checked_pose(pose);
    } catch (const Error& error) {
      throw error.behind("pose " + std::to_string(i + 1) + " of " +
                         std::to_string(world_T_tool.cols()) + ": ");
    }
  }
}

BatchResult solve_columns(const Arm& arm, const ConstColumnsRef<double>& world_T_tool,
                          const ConstColumnsRef<double>& seeds, ColumnsRef<double>& q,
                          InverseOutcome* outcomes, const InverseOptions& inverse,
                          const BatchOptions& options) {
  const Eigen::Index count = world_T_tool.cols();
  check_rows(arm, "world_T_tool", world_T_tool, size(options.layout));
  check_shape(arm, "q", q, arm.dof(), count);
  check_rows(arm, "seeds", seeds, arm.dof());
  if (seeds.cols() != 1) check_shape(arm, "seeds", seeds, arm.dof(), count);

  check_poses(arm, world_T_tool, inverse.task, options.layout);
  if (inverse.all) throw Error("", "all", " is for one pose; a batch has one solution for each");
  InverseOptions one = inverse;
  Counts counts(options.budget, count);
  one.budget = counts.budget().part();
  inverse_method(arm, one);  // checks the options
  constexpr Eigen::Index block = 32;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  in_parallel(count, block, options.threads, [&](Eigen::Index first, Eigen::Index last) {
    InverseOptions with_seed = one;
    for (Eigen::Index i = first; i < last; ++i) {
      if (counts.budget().ended()) {
        q.middleCols(i, last - i).setConstant(unknown);
        return;
      }
      const auto seed = seeds.col(seeds.cols() == 1 ? 0 : i);
      const double* pose = world_T_tool.data() + i * world_T_tool.outerStride();
      const bool finite = world_T_tool.col(i).allFinite() && seed.allFinite();
      bool found =
          finite && solve_column(arm, pose_in_layout(pose, options.layout), seed, with_seed,
                                 q.middleCols(i, 1), outcomes ? outcomes + i : nullptr);
      if (!counts.budget().complete())
        found = false;  // an interrupted search may have missed a nearer solution
      if (!found) q.col(i).setConstant(unknown);
      if (found || counts.budget().complete()) counts.add(1, found);
    }
  });
  return counts.result();
}

}  // namespace

BatchResult batch_inverse(const Arm& arm, const ConstColumnsRef<double>& world_T_tool,
                          const ConstColumnsRef<double>& seeds, ColumnsRef<double> q,
                          const InverseOptions& inverse, const BatchOptions& options) {
  return solve_columns(arm, world_T_tool, seeds, q, nullptr, inverse, options);
}

BatchResult batch_inverse(const Arm& arm, const ConstColumnsRef<double>& world_T_tool,
                          const ConstColumnsRef<double>& seeds, ColumnsRef<double> q,
                          std::vector<InverseOutcome>& outcomes, const InverseOptions& inverse,
                          const BatchOptions& options) {
  outcomes.assign(static_cast<std::size_t>(world_T_tool.cols()),
                  {InverseStatus::cancelled, std::numeric_limits<double>::quiet_NaN()});
  const BatchResult result =
      solve_columns(arm, world_T_tool, seeds, q, outcomes.data(), inverse, options);
  if (result.ending != Ending::complete) {
    for (InverseOutcome& outcome : outcomes) {
      if (std::isnan(outcome.residual)) {
        outcome.status = internal::status_of<InverseStatus>(result.ending);
      }
    }
  }
  return result;
}

}  // namespace beeline
