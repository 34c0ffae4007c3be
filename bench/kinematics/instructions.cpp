// Repeats one call for callgrind: bench_instructions CASE ARM. Instruction counts are reproducible
// where times are not. The cases of inverse kinematics have the same kind of poses as
// bench_inverse.

#include <cstdio>
#include <string>

#include <beeline/batch/batch.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

#include "../inverse/beeline_case.h"
#include "../inverse/poses.h"

namespace beeline::bench {
namespace {

volatile double sink = 0;

/// What callgrind counts: callgrind finds it by its name.
template <class Call>
__attribute__((noinline)) void counted_calls(int calls, const Call& call) {
  for (int i = 0; i < calls; ++i) sink = call(i);
  std::printf("%d\n", calls);
}

void count_forward(const Arm& arm) {
  const Configuration q = Configuration::Constant(arm.dof(), 0.3);
  counted_calls(1000, [&](int) { return forward_kinematics(arm, q)(0, 3); });
}

void count_jacobian(const Arm& arm) {
  const Configuration q = Configuration::Constant(arm.dof(), 0.3);
  Jacobian columns(6, arm.dof());
  counted_calls(1000, [&](int) { return jacobian(arm, q, columns)(0, 3); });
}

/// One thread; a call is one configuration of 10000.
template <class Real>
void count_batch(const Arm& arm) {
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  constexpr int rows = 10000;
  const Matrix q = Matrix::Constant(arm.dof(), rows, Real(0.3));
  Matrix poses(16, rows);
  counted_calls(rows, [&](int i) {
    if (i == 0) batch_forward<Real>(arm, q, poses, {.threads = 1});
    return double(poses(12, i));
  });
}

void count_inverse(const BenchArm& arm, CaseKind kind) {
  constexpr int calls = 200;
  const Screws screws = screws_of(arm);
  const Poses poses = random_poses(screws, calls, 20240229);
  const Configuration centre = middle(screws);
  BeelineCase solver(arm, kind);
  const auto solve = [&](int i) {
    const auto n = static_cast<std::size_t>(i);
    const bool near = kind == CaseKind::tracking;
    return double(solver.solve(poses.world_T_tool[n], near ? poses.near[n] : centre));
  };
  sink = solve(0);  // makes the tables that all calls share
  counted_calls(calls, solve);
}

void count(const std::string& name, const BenchArm& arm) {
  if (name == "forward") return count_forward(arm.arm);
  if (name == "jacobian") return count_jacobian(arm.arm);
  if (name == "batch") return count_batch<double>(arm.arm);
  if (name == "batch-float") return count_batch<float>(arm.arm);
  if (name == "all-solutions") return count_inverse(arm, CaseKind::all_solutions);
  if (name == "numerical") return count_inverse(arm, CaseKind::numerical_free);
  if (name == "tracking") return count_inverse(arm, CaseKind::tracking);
  throw Error("no case " + name +
              ": forward, jacobian, batch, batch-float, all-solutions, numerical, tracking");
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: bench_instructions CASE ARM\n");
    return 2;
  }
  try {
    beeline::bench::count(argv[1], beeline::bench::bench_arm(argv[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_instructions: %s\n", error.what());
    return 2;
  }
  return 0;
}
