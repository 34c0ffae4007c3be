#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>

#include <tests/fuzz/bytes.h>
#include <tests/fuzz/target.h>

namespace beeline::fuzz {
namespace {

InverseOptions options_of(Bytes& bytes, const Arm& arm) {
  InverseOptions options{.all = bytes.flag(), .grid = 4, .max_restarts = 8};
  options.ignore_limits = bytes.integer(0, 7) == 0;
  if (bytes.integer(0, 7) == 0) options.method = InverseMethod::numerical;
  if (bytes.integer(0, 7) == 0) options.redundancy = Redundancy::nearest;
  if (bytes.integer(0, 7) == 0) options.redundancy = Redundancy::centred;
  if (bytes.integer(0, 7) == 0) options.task = Task::position();
  if (bytes.integer(0, 7) == 0 && arm.dof() > 1) options.lock = bytes.integer(0, arm.dof() - 1);
  if (bytes.integer(0, 7) == 0) {
    options.pose_tolerance = Eigen::VectorXd::Constant(arm.planar() ? 3 : 6, 0.01);
  }
  return options;
}

void check_solutions(const Arm& arm, const Pose& goal, const InverseOptions& options,
                     const InverseResult& result) {
  const Task task = options.task.value_or(default_task(arm));
  for (const Configuration& q : result.solutions) {
    require(q.size() == arm.dof() && q.allFinite(), "a finite solution");
    require(options.ignore_limits || limit_violations(arm, q).empty(), "within limits");
    if (result.deviation) continue;
    const Deviation error = task_deviation(task, goal, forward_kinematics(arm, q));
    require(std::max(error.position, error.orientation) < 1e-9, "a solution reaches the pose");
  }
  require(result.solutions.empty() == (result.status != InverseStatus::solved), "the status");
  require(result || bool(result.reason), "a reason");
}

}  // namespace
}  // namespace beeline::fuzz

// Solutions reach the pose; a pose that was computed from a configuration within limits is never
// proved to have no solution.
BEELINE_FUZZ_TARGET(inverse) {
  using namespace beeline;
  fuzz::Bytes bytes(input);
  fuzz::may_refuse([&] {
    const Arm arm = bytes.arm();
    InverseOptions options = fuzz::options_of(bytes, arm);
    const Configuration q = bytes.configuration(arm);
    const bool reachable = bytes.integer(0, 3) != 0;
    const Pose goal = reachable ? forward_kinematics(arm, q) : bytes.pose();
    options.seed = options.lock ? q : bytes.configuration(arm);
    const InverseResult result = inverse_kinematics(arm, goal, options);
    fuzz::check_solutions(arm, goal, options, result);
    if (!reachable) return;
    fuzz::require(result.status != InverseStatus::unreachable, "reachable");
    const bool proved = result.reason.code == ReasonCode::all_solutions_outside_limits;
    fuzz::require(!proved, "a solution is within limits");
    const bool complete = result.complete && result.solutions.empty();
    fuzz::require(!complete, "not all solutions");
  });
}
