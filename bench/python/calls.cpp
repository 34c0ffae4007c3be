// The C++ time of what calls.py calls from Python, on the same numbers: a library that it loads.
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include <beeline/batch/batch.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>

namespace {

using beeline::Configuration;
using beeline::Pose;
using Map = Eigen::Map<const Eigen::MatrixXd>;

double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The CPU time of call(i) for every i. Each is called once before: one that finds nothing may
/// prepare more of the arm.
template <class Call>
double time_of(long count, Call call) {
  for (long i = 0; i < count; ++i) call(i);
  const double begin = seconds(CLOCK_THREAD_CPUTIME_ID);
  for (long i = 0; i < count; ++i) call(i);
  return seconds(CLOCK_THREAD_CPUTIME_ID) - begin;
}

volatile double sink;

}  // namespace

/// The time of `what` for all configurations (dof x count) and poses (16 x count), seconds. `json`
/// describes the arm.
extern "C" double time_calls(const char* json, const char* what, const double* q_data,
                             const double* pose_data, long count) {
  const beeline::Arm arm = beeline::arm_from_json(json, "arm");
  const Map q(q_data, arm.dof(), count);
  std::vector<Pose> poses(static_cast<std::size_t>(count));
  for (long i = 0; i < count; ++i) {
    poses[i].matrix() = Eigen::Map<const Eigen::Matrix4d>(pose_data + 16 * i);
  }
  const std::string call = what;
  if (call == "forward") {
    return time_of(count, [&](long i) { sink = forward_kinematics(arm, q.col(i))(0, 3); });
  }
  if (call == "jacobian") {
    beeline::Jacobian columns(6, arm.dof());
    return time_of(count, [&](long i) {
      jacobian(arm, q.col(i), columns);
      sink = columns(0, 0);
    });
  }
  if (call == "inverse_into") {
    const Configuration seed = middle_configuration(arm);
    Eigen::MatrixXd solution(arm.dof(), 1);
    return time_of(count, [&](long i) {
      inverse_kinematics(arm, poses[i], seed, solution);
      sink = solution(0, 0);
    });
  }
  if (call == "first") {  // of a fresh arm each
    double all = 0;
    for (long i = 0; i < count; ++i) {
      const beeline::Arm fresh = beeline::arm_from_json(json, "arm");
      const double begin = seconds(CLOCK_THREAD_CPUTIME_ID);
      sink = inverse_kinematics(fresh, poses[i]).residual;
      all += seconds(CLOCK_THREAD_CPUTIME_ID) - begin;
    }
    return all;
  }
  beeline::InverseOptions options;
  options.all = options.ignore_limits = call == "all";
  return time_of(count,
                 [&](long i) { sink = inverse_kinematics(arm, poses[i], options).residual; });
}

/// The time of a batch, seconds: CPU time with one thread, else wall time. Without `results` the
/// memory for them is allocated within that time.
extern "C" double time_batch(const char* json, const char* what, const double* q_data,
                             double* results, long count, int threads) {
  const beeline::Arm arm = beeline::arm_from_json(json, "arm");
  const bool poses = std::strcmp(what, "forward") == 0;
  const Eigen::Index rows = poses ? 16 : 6 * arm.dof();
  const Map q(q_data, arm.dof(), count);
  beeline::BatchOptions options;
  options.threads = threads;
  const clockid_t clock = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  const double begin = seconds(clock);
  Eigen::MatrixXd fresh;
  if (results == nullptr) fresh.resize(rows, count);
  Eigen::Map<Eigen::MatrixXd> out(results ? results : fresh.data(), rows, count);
  if (poses) {
    beeline::batch_forward<double>(arm, q, out, options);
  } else {
    Eigen::MatrixXd none(16, 0);
    beeline::batch_jacobian<double>(arm, q, out, none, options);
  }
  return seconds(clock) - begin;
}
